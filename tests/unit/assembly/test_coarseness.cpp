#include "algebra/decompositions.hpp"
#include "assembly/coarseness.hpp"
#include "assembly/galerkin_static.hpp"
#include "assembly/mesh_coarseness.hpp"
#include "mesh/grid_shapes.hpp"
#include "mesh/shapes.hpp"
#include "quadrature/triangle_rules.hpp"
#include "support/bodies.hpp"

#include <functional>
#include <set>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

using Field = std::function<Vec3(const Vec3&)>;

Eigen::VectorXd values_of(const TriangleMesh& mesh, const Field& field) {
  Eigen::VectorXd out(3 * mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    out.segment<3>(static_cast<Eigen::Index>(3 * i)) = field(mesh.vertices[i]);
  return out;
}

double eta(const TriangleMesh& mesh, const Field& field) {
  const FieldNorms norms = Coarseness(mesh).norms(values_of(mesh, field));
  return norms.bubbles / norms.deformation;
}

Vec3 bending(const Vec3& x) {
  return {-x[0] * x[2], 0, 0.5 * x[0] * x[0]};
}

Mat3 turned() {
  return Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
}

/// The mesh turned, scaled and moved.
TriangleMesh elsewhere(TriangleMesh mesh, double scale) {
  for (Vec3& x : mesh.vertices) x = scale * (turned() * x) + Vec3(4, 5, -6);
  return mesh;
}

/// int |b|^2 and int |u - r|^2 by quadrature and a fit of rigid motions at its points.
FieldNorms norms_by_quadrature(const TriangleMesh& mesh, const Eigen::VectorXd& displacement) {
  const EdgeReconstruction reconstruction(mesh);
  const TriangleRule& rule = triangle_rules()[2];
  const auto points = static_cast<Eigen::Index>(mesh.triangles.size()) * rule.size;
  Eigen::MatrixXd rigid(3 * points, 6);
  Eigen::VectorXd u(3 * points), b(3 * points);
  Eigen::Index row = 0;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const TriangleBasis basis = triangle_basis(mesh, reconstruction, t);
    for (int q = 0; q < rule.size; ++q, row += 3) {
      const double* l = rule.points[q].barycentric;
      const double root = std::sqrt(rule.points[q].weight * triangle_area(mesh, mesh.triangles[t]));
      const auto shape = quadratic_shapes(l);
      Vec3 x = Vec3::Zero(), linear = Vec3::Zero(), whole = Vec3::Zero();
      for (int k = 0; k < 3; ++k) {
        const Eigen::Index v = mesh.triangles[t][k];
        x += l[k] * mesh.vertices[v];
        linear += l[k] * displacement.segment<3>(3 * v);
      }
      for (std::size_t j = 0; j < basis.vertices.size(); ++j)
        for (int i = 0; i < 6; ++i)
          whole += basis.weights[j][i] * shape[i] *
                   displacement.segment<3>(3 * Eigen::Index{basis.vertices[j]});
      u.segment<3>(row) = root * whole;
      b.segment<3>(row) = root * (whole - linear);
      rigid.block<3, 3>(row, 0) = root * Mat3::Identity();
      rigid.block<3, 3>(row, 3) = -root * cross_matrix(x);
    }
  }
  return {b.norm(), (u - rigid * least_squares(rigid, u)).norm()};
}

}  // namespace

TEST_CASE("the mass matrix of quadratic shape functions is that of a quadrature rule") {
  const Eigen::Matrix<double, 6, 6> mass = quadratic_mass();
  Eigen::Matrix<double, 6, 6> expected = Eigen::Matrix<double, 6, 6>::Zero();
  const TriangleRule& rule = triangle_rules()[2];  // of degree 4
  for (int q = 0; q < rule.size; ++q) {
    const auto shape = quadratic_shapes(rule.points[q].barycentric);
    const Eigen::Map<const Vector6> s(shape.data());
    expected += rule.points[q].weight * s * s.transpose();
  }
  CHECK((mass - expected).cwiseAbs().maxCoeff() < 1e-14);
  const PairTractions with_linear = mass_matrix(2.5);
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j < 3; ++j)
      CHECK(with_linear(3 * i, 3 * j) == Approx(2.5 * mass(i, j)).margin(1e-14));
}

TEST_CASE("norms of a field agree with quadrature", "[coarseness]") {
  for (const TriangleMesh& mesh : {elsewhere(star(1, 1), 1), elsewhere(notched_cube(1, 2), 0.3),
                                   box(Vec3(1, 0.2, 0.3), {5, 1, 2})}) {
    std::srand(3);
    const Eigen::VectorXd u =
        Eigen::VectorXd::Random(static_cast<Eigen::Index>(3 * mesh.vertices.size()));
    const FieldNorms found = Coarseness(mesh).norms(u), expected = norms_by_quadrature(mesh, u);
    CHECK(found.bubbles == Approx(expected.bubbles).epsilon(1e-12));
    CHECK(found.deformation == Approx(expected.deformation).epsilon(1e-12));
    CHECK(expected.bubbles > 0.01 * expected.deformation);
  }
}

TEST_CASE("rigid motions and uniform strain have no bubble part", "[coarseness]") {
  const Mat3 gradient = (Mat3() << 0.1, 0.3, -0.2, 0.1, 0.8, 0.15, -0.05, 0.2, 0.3).finished();
  for (const TriangleMesh& mesh : {elsewhere(icosphere(1, 1), 1), elsewhere(star(2, 1), 1),
                                   elsewhere(notched_cube(1, 2), 1)}) {
    const Coarseness coarseness(mesh);
    const FieldNorms strained = coarseness.norms(
        values_of(mesh, [&](const Vec3& x) { return Vec3(Vec3(1, 2, 3) + gradient * x); }));
    CHECK(strained.bubbles < 1e-13 * strained.deformation);
    CHECK(strained.deformation > 0.1);
    const FieldNorms rigid = coarseness.norms(values_of(
        mesh, [&](const Vec3& x) { return Vec3(Vec3(1, 2, 3) + Vec3(-2, 1, 0.5).cross(x)); }));
    CHECK(rigid.deformation < 1e-13 * coarseness.area());
    CHECK(rigid.bubbles < 1e-13 * coarseness.area());
  }
}

TEST_CASE("the part of bubbles depends on the shape of mesh and motion alone", "[coarseness]") {
  const TriangleMesh mesh = star(1, 1), other = elsewhere(mesh, 0.01);
  const Mat3 back = turned().transpose();
  const Field moved = [&](const Vec3& x) {
    const Vec3 at = back * (x - Vec3(4, 5, -6)) / 0.01;
    const Vec3 motion = Vec3(1, 1, 0) + Vec3(3, 0, 1).cross(at);
    return Vec3(1e-6 * (turned() * (bending(at) + motion)));
  };
  CHECK(eta(other, moved) == Approx(eta(mesh, bending)).epsilon(1e-9));
}

TEST_CASE("bubbles of a quadratic field are an eighth of h^2 times its second derivative",
          "[coarseness]") {
  // u = x^2/2 along z, on cells of h along x: of the three edges of a triangle beside the axis two
  // run over h, and their bubbles are -h^2/8; those at the ends have none
  const double length = 1, width = 0.2, h = 0.05;
  const TriangleMesh beam = centred(box(Vec3(length, width, width), {20, 4, 4}));
  const Eigen::VectorXd u =
      values_of(beam, [](const Vec3& x) { return Vec3(0, 0, 0.5 * x[0] * x[0]); });
  const Coarseness coarseness(beam);
  const double bubble = h * h / 8, sides = 4 * length * width;
  CHECK(coarseness.norms(u).bubbles == Approx(bubble * std::sqrt(24.0 / 45 * sides)).epsilon(0.02));
  const WorstEdge worst = coarseness.worst_edge(u);
  CHECK(worst.bubble == Approx(bubble).epsilon(0.05));
  const Vec3 a = beam.vertices[worst.vertices[0]], b = beam.vertices[worst.vertices[1]];
  CHECK(std::abs(a[0] - b[0]) == Approx(h));
  CHECK((worst.midpoint - 0.5 * (a + b)).norm() < 1e-15);
}

TEST_CASE("the part of bubbles falls with the square of the edges", "[coarseness]") {
  const auto beam = [](int n) { return centred(box(Vec3(1, 0.2, 0.2), {5 * n, n, n})); };
  const Field wave = [](const Vec3& x) { return Vec3(0, std::sin(4 * x[0]), std::cos(3 * x[0])); };
  for (const Field& field : {Field(bending), wave}) {
    const double coarse = eta(beam(2), field), medium = eta(beam(4), field),
                 fine = eta(beam(8), field);
    std::printf("part of bubbles, beam: %.4f %.4f %.4f\n", coarse, medium, fine);
    CHECK(coarse / medium == Approx(4).epsilon(0.1));
    CHECK(medium / fine == Approx(4).epsilon(0.05));
  }
  CHECK(eta(icosphere(1, 1), bending) / eta(icosphere(2, 1), bending) == Approx(4).epsilon(0.1));
}

TEST_CASE("the worst edge and the triangles to cut are where the field bends", "[coarseness]") {
  const TriangleMesh beam = centred(box(Vec3(1, 0.2, 0.2), {20, 4, 4}));
  const Coarseness coarseness(beam);
  const Eigen::VectorXd kink = values_of(
      beam, [](const Vec3& x) { return Vec3(0, 0, std::exp(-std::pow((x[0] - 0.3) / 0.08, 2))); });
  const WorstEdge worst = coarseness.worst_edge(kink);
  CHECK(std::abs(worst.midpoint[0] - 0.3) < 0.1);
  const Refinement local = coarseness.halving(kink);
  const Refinement everywhere = coarseness.halving(values_of(beam, bending));
  CHECK(local.triangles < 0.3 * static_cast<double>(beam.triangles.size()));
  CHECK(everywhere.triangles > 2 * local.triangles);
  // each triangle that is cut shares its edges with one other at most
  for (const Refinement& r : {local, everywhere}) {
    const auto added = static_cast<double>(r.nodes - beam.vertices.size());
    CHECK(added >= 1.5 * static_cast<double>(r.triangles));
    CHECK(added <= 3 * static_cast<double>(r.triangles));
  }
}

TEST_CASE("the triangles to cut are the fewest with four fifths of the squares", "[coarseness]") {
  const TriangleMesh mesh = star(1, 1);
  std::srand(5);
  const Eigen::VectorXd u =
      Eigen::VectorXd::Random(static_cast<Eigen::Index>(3 * mesh.vertices.size()));
  const EdgeReconstruction reconstruction(mesh);
  std::vector<std::pair<double, int>> squares;
  double sum = 0;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    std::array<Vec3, 3> b;
    for (int k = 0; k < 3; ++k) {
      const int e = reconstruction.edges().of[t][k];
      b[k].setZero();
      for (Eigen::Index v = 0; v < reconstruction.coefficients().cols(); ++v)
        b[k] += reconstruction.coefficients().coeff(e, v) * u.segment<3>(3 * v);
    }
    squares.emplace_back(triangle_area(mesh, mesh.triangles[t]) * bubble_square(b[0], b[1], b[2]),
                         t);
    sum += squares.back().first;
  }
  CHECK(std::sqrt(sum) == Approx(Coarseness(mesh).norms(u).bubbles).epsilon(1e-12));
  std::sort(squares.rbegin(), squares.rend());
  std::set<int> edges;
  double left = sum;
  std::size_t cut = 0;
  while (left > sum / 4) {
    left -= 15.0 / 16 * squares[cut].first;
    for (int e : reconstruction.edges().of[squares[cut].second]) edges.insert(e);
    ++cut;
  }
  const Refinement found = Coarseness(mesh).halving(u);
  CHECK(found.triangles == cut);
  CHECK(found.nodes == mesh.vertices.size() + edges.size());
}

TEST_CASE("the coarseness of a mesh is of second order and depends on its shape alone") {
  for (const auto& [coarse, fine] :
       {std::make_pair(box(Vec3(1, 0.2, 0.2), {10, 2, 2}), box(Vec3(1, 0.2, 0.2), {20, 4, 4})),
        std::make_pair(box(Vec3(1, 1, 0.02), {10, 10, 1}), box(Vec3(1, 1, 0.02), {20, 20, 2})),
        std::make_pair(icosphere(2, 1), icosphere(3, 1)), std::make_pair(star(3, 1), star(4, 1))}) {
    const double value = mesh_coarseness(coarse);
    std::printf("coarseness: %.4f, finer %.4f\n", value, mesh_coarseness(fine));
    CHECK(value / mesh_coarseness(fine) == Approx(4).epsilon(0.1));
    CHECK(mesh_coarseness(elsewhere(coarse, 0.01)) == Approx(value).epsilon(1e-7));
  }
}

TEST_CASE("the coarseness of a slender beam is that of its bending") {
  // of u = x^2/2 with cells of h: see above; its norm without the affine part is that of
  // x^2/2 - L^2/24 on four sides: (h^2/8) (24/45)^(1/2) / (L^4/720)^(1/2)
  const double ratio = 0.1;  // h/L
  const double expected = ratio * ratio / 8 * std::sqrt(24.0 / 45 * 720);
  CHECK(mesh_coarseness(box(Vec3(10, 0.2, 0.2), {10, 4, 4})) == Approx(expected).epsilon(0.03));
  CHECK(mesh_coarseness(box(Vec3(0.2, 10, 0.2), {4, 10, 4})) == Approx(expected).epsilon(0.03));
}

TEST_CASE("the softness of a slender beam is that of its bending") {
  // u = x^2/2 across a beam of L x b x b, up to what is of order (b/L)^2: the mean of the square of
  // its part without affine fields is L^4/720, int tr(eps^2) dV is L b^4/12
  const double length = 10, width = 0.2;
  const double expected = std::pow(length, 3) * 12 / (720 * std::pow(width, 4));
  CHECK(softness(box(Vec3(length, width, width), {20, 1, 1})) == Approx(expected).epsilon(0.05));
  CHECK(softness(box(Vec3(width, length, width), {1, 20, 1})) == Approx(expected).epsilon(0.05));
}

TEST_CASE("one cell across a body is coarse") {
  CHECK(mesh_coarseness(box(Vec3(1, 1, 1), {1, 1, 1})) > 0.5);
  CHECK(mesh_coarseness(icosphere(0, 1)) > 0.3);
}
