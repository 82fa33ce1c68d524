#include "model/energy_matrices.hpp"
#include "support/models.hpp"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

const Material kRubber = material(1000, 1e6, 0.3);

/// A body and its matrices.
struct Solid {
  BodyGeometry geometry;
  EnergyMatrices energies;

  explicit Solid(const TriangleMesh& mesh) : geometry(geometry_of(mesh, kRubber.density)) {
    Discretisation d = quasistatic_options(geometry, kRubber).discretisation;
    d.method = SpatialMethod::galerkin;
    energies = energy_matrices(geometry, d);
  }
  /// The values of a field at the nodes.
  template <class F>
  Eigen::VectorXd at_nodes(const F& field) const {
    const std::vector<Vec3>& nodes = geometry.nodes.vertices;
    Eigen::VectorXd u(static_cast<Eigen::Index>(3 * nodes.size()));
    for (std::size_t i = 0; i < nodes.size(); ++i)
      u.segment<3>(static_cast<Eigen::Index>(3 * i)) = field(nodes[i]);
    return u;
  }
  double elastic(const Eigen::VectorXd& u) const { return 0.5 * u.dot(energies.stiffness * u); }
  double kinetic(const Eigen::VectorXd& v) const { return 0.5 * v.dot(energies.mass * v); }
};

double elastic_of_strain(const BodyGeometry& geometry, const Mat3& strain) {
  const double mu = kRubber.shear_modulus, nu = kRubber.poisson_ratio;
  const double lame = 2 * mu * nu / (1 - 2 * nu);
  return geometry.mass.volume *
         (0.5 * lame * strain.trace() * strain.trace() + mu * strain.squaredNorm());
}

/// Of the velocities `gradient` x.
double kinetic_of_gradient(const BodyGeometry& geometry, const Mat3& gradient) {
  const Mat3& inertia = geometry.mass.inertia;
  const Mat3 second = 0.5 * inertia.trace() * Mat3::Identity() - inertia;
  return 0.5 * (gradient * second * gradient.transpose()).trace();
}

std::vector<Mat3> strains() {
  Mat3 along = Mat3::Zero(), thick = Mat3::Zero(), shear = Mat3::Zero();
  along(0, 0) = thick(2, 2) = 1;
  shear(0, 1) = shear(1, 0) = 0.5;
  return {along, thick, shear, Mat3::Identity()};
}

/// How far the mass of linear velocities is from that of the solid, relative.
double worst_kinetic(const Solid& solid) {
  double worst = 0;
  for (const Mat3& strain : strains()) {
    const Eigen::VectorXd v = solid.at_nodes([&](const Vec3& x) { return Vec3(strain * x); });
    worst = std::max(worst,
                     std::abs(solid.kinetic(v) / kinetic_of_gradient(solid.geometry, strain) - 1));
  }
  return worst;
}

/// Pure bending of a bar along x, a solution of the equations inside, with unit curvature.
Vec3 bending(const Vec3& x) {
  const double nu = kRubber.poisson_ratio;
  return {x[0] * x[2], -nu * x[1] * x[2],
          -0.5 * (x[0] * x[0] - nu * x[1] * x[1] + nu * x[2] * x[2])};
}

/// Its kinetic energy in a box, by Gauss points that are exact for it.
double kinetic_of_bending(const Vec3& size) {
  const double points[] = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, weights[] = {5.0, 8.0, 5.0};
  double sum = 0;
  for (int i = 0; i < 27; ++i) {
    const Vec3 x = 0.5 * size.cwiseProduct(Vec3(points[i % 3], points[i / 3 % 3], points[i / 9]));
    sum += weights[i % 3] * weights[i / 3 % 3] * weights[i / 9] * bending(x).squaredNorm();
  }
  return 0.5 * kRubber.density * size.prod() * sum / std::pow(18, 3);
}

}  // namespace

TEST_CASE("rigid motions have no elastic energy, and the kinetic energy of mass and inertia") {
  for (const TriangleMesh& mesh :
       {random_tetrahedron(7), box(Vec3(1, 0.6, 0.5), {4, 3, 2}), icosphere(2, 0.5)}) {
    const Solid solid(mesh);
    Eigen::MatrixXd rigid(static_cast<Eigen::Index>(3 * solid.geometry.nodes.vertices.size()), 6);
    rigid << translations(solid.geometry.nodes), rotations(solid.geometry.nodes);
    const EnergyMatrices& e = solid.energies;
    CHECK((e.stiffness * rigid).norm() < 1e-12 * e.stiffness.norm() * rigid.norm());
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(6, 6);
    expected.topLeftCorner<3, 3>() = solid.geometry.mass.mass * Mat3::Identity();
    expected.bottomRightCorner<3, 3>() = solid.geometry.mass.inertia;
    CHECK((rigid.transpose() * e.mass * rigid - expected).norm() < 5e-5 * expected.norm());
    CHECK(e.stiffness.isApprox(e.stiffness.transpose(), 1e-14));
    CHECK(e.mass.isApprox(e.mass.transpose(), 1e-14));
  }
}

TEST_CASE("uniform strain has the elastic energy of the solid on every mesh") {
  for (const TriangleMesh& mesh :
       {random_tetrahedron(7), box(Vec3(1, 1, 0.05), {5, 5, 1}), icosphere(1, 0.5)}) {
    const Solid solid(mesh);
    for (const Mat3& strain : strains())
      CHECK(solid.elastic(solid.at_nodes([&](const Vec3& x) { return Vec3(strain * x); })) ==
            Approx(elastic_of_strain(solid.geometry, strain)).epsilon(1e-10));
  }
}

TEST_CASE("linear velocities have the kinetic energy of the solid") {
  CHECK(worst_kinetic(Solid(icosphere(2, 0.5))) < 6e-4);
  // edges, and a thickness of one cell
  CHECK(worst_kinetic(Solid(box(Vec3(1, 1, 0.05), {10, 10, 1}))) < 0.03);
  const double coarse = worst_kinetic(Solid(box(Vec3(1, 0.6, 0.5), {4, 3, 2}))),
               fine = worst_kinetic(Solid(box(Vec3(1, 0.6, 0.5), {8, 6, 4})));
  CHECK(coarse < 0.02);
  CHECK(fine < 0.5 * coarse);
}

TEST_CASE("both energies of a bent bar converge to those of the solid") {
  const Vec3 size(10, 1, 1);
  const double young = 2 * kRubber.shear_modulus * (1 + kRubber.poisson_ratio);
  const double elastic = 0.5 * young * size[0] * size[1] * std::pow(size[2], 3) / 12;
  const auto errors = [&](const std::array<int, 3>& divisions) {
    const Solid solid(box(size, divisions));
    const Eigen::VectorXd u = solid.at_nodes(bending);
    return std::pair(std::abs(solid.elastic(u) / elastic - 1),
                     std::abs(solid.kinetic(u) / kinetic_of_bending(size) - 1));
  };
  const auto [coarse, coarse_mass] = errors({20, 2, 2});
  const auto [fine, fine_mass] = errors({40, 4, 4});
  CHECK(coarse < 0.01);
  CHECK(fine < 0.3 * coarse);
  CHECK(coarse_mass < 0.002);
  CHECK(fine_mass < 0.002);
}

TEST_CASE("the mass of a stocky box knows that its inside is deformed") {
  const Vec3 size(1, 0.6, 0.5);
  const Solid solid(box(size, {8, 6, 4}));
  CHECK(solid.kinetic(solid.at_nodes(bending)) == Approx(kinetic_of_bending(size)).epsilon(0.004));
}

TEST_CASE("deformations of a ball have positive energies") {
  const Solid solid(icosphere(2, 0.5));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> stiffness(solid.energies.stiffness),
      mass(solid.energies.mass);
  CHECK(stiffness.eigenvalues()[5] < 1e-10 * stiffness.eigenvalues()[6]);
  CHECK(stiffness.eigenvalues()[6] > 0);
  CHECK(mass.eigenvalues()[0] > 0);
}
