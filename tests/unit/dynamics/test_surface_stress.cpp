#include "dynamics/surface_stress.hpp"
#include "mesh/shapes.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

const Material kMaterial{"test", 1000, 4e5, 0.3, {}};

/// Components of a symmetric tensor in the order of StressField.
Vector6 entries_of(const Mat3& m) {
  Vector6 s;
  s << m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(0, 2);
  return s;
}

Mat3 hooke(const Mat3& strain) {
  const double lambda =
      2 * kMaterial.shear_modulus * kMaterial.poisson_ratio / (1 - 2 * kMaterial.poisson_ratio);
  return 2 * kMaterial.shear_modulus * strain + lambda * strain.trace() * Mat3::Identity();
}

/// Largest error of the stress at the vertices within the side y > 0, away from its rim, of
/// a box around the origin; u(x) and its stress.
template <class U, class Sigma>
double error_on_side(const TriangleMesh& mesh, const Vec3& size, const U& u, const Sigma& sigma) {
  const auto n = static_cast<Eigen::Index>(mesh.vertices.size());
  Eigen::VectorXd displacements(3 * n);
  Eigen::Matrix3Xd tractions(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    displacements.segment<3>(3 * i) = u(mesh.vertices[i]);
    tractions.col(i) = sigma(mesh.vertices[i]).col(1);  // the normal is that of y
  }
  const StressField found = SurfaceStress(mesh, kMaterial).at_nodes(displacements, tractions);
  double worst = 0;
  int seen = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3& x = mesh.vertices[i];
    const Vec3 within = 0.2 * size;
    if (x.y() < size.y() / 2 - 1e-9 || std::abs(x.x()) > within.x() || std::abs(x.z()) > within.z())
      continue;
    ++seen;
    worst = std::max(worst, (found.col(i) - entries_of(sigma(x))).norm());
  }
  CHECK(seen > 3);
  return worst;
}

}  // namespace

TEST_CASE("uniform strain has its stress at every flat place of the surface") {
  const Vec3 size(1, 0.5, 1);
  Mat3 gradient;
  gradient << 1, 2, -3, 0.5, -1, 4, 2, 0.25, 3;
  gradient *= 1e-3;
  const Mat3 stress = hooke(0.5 * (gradient + gradient.transpose()));
  const double error = error_on_side(
      box(size, {8, 4, 8}), size, [&](const Vec3& x) { return Vec3(gradient * x); },
      [&](const Vec3&) { return stress; });
  CHECK(error < 1e-12 * stress.norm());
}

TEST_CASE("pure bending has the stress of beam theory on the sides of the beam") {
  const Vec3 size(1, 0.5, 1);
  const double curvature = 0.01, nu = kMaterial.poisson_ratio;
  const double young = 2 * kMaterial.shear_modulus * (1 + nu);
  // bent about z, with the neutral plane y = 0
  const auto u = [&](const Vec3& x) -> Vec3 {
    return curvature * Vec3(-x.x() * x.y(),
                            0.5 * (x.x() * x.x() + nu * (x.y() * x.y() - x.z() * x.z())),
                            nu * x.y() * x.z());
  };
  const auto sigma = [&](const Vec3& x) {
    Mat3 s = Mat3::Zero();
    s(0, 0) = -young * curvature * x.y();
    return s;
  };
  const double error = error_on_side(box(size, {8, 4, 8}), size, u, sigma);
  CHECK(error < 1e-9 * young * curvature * size.y());
}

TEST_CASE("the stress of a pressed sphere is the pressure, better on finer meshes") {
  const double pressure = 100, bulk = 2 * kMaterial.shear_modulus * (1 + kMaterial.poisson_ratio) /
                                      (3 * (1 - 2 * kMaterial.poisson_ratio));
  const double bounds[] = {0.02, 0.005};
  for (int subdivisions : {1, 2}) {
    const TriangleMesh mesh = icosphere(subdivisions, 0.1);
    const auto n = static_cast<Eigen::Index>(mesh.vertices.size());
    Eigen::VectorXd displacements(3 * n);
    Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, n);  // of the pressure on the triangles
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < n; ++i)
      displacements.segment<3>(3 * i) = -pressure / (3 * bulk) * mesh.vertices[i];
    for (const Triangle& t : mesh.triangles)
      for (int v : t) {
        forces.col(v) -= pressure * triangle_area(mesh, t) / 3 * triangle_normal(mesh, t);
        areas[v] += triangle_area(mesh, t) / 3;
      }
    const StressField found =
        SurfaceStress(mesh, kMaterial)
            .at_nodes(displacements, forces * areas.cwiseInverse().asDiagonal());
    Vector6 exact;
    exact << -pressure, -pressure, -pressure, 0, 0, 0;
    CHECK((found.colwise() - exact).cwiseAbs().maxCoeff() < bounds[subdivisions - 1] * pressure);
  }
}

TEST_CASE("the equivalent stress of simple states is that of von Mises") {
  Vector6 stress;
  stress << -3, 0, 0, 0, 0, 0;
  CHECK(von_mises(stress) == Approx(3));
  stress << 0, 0, 0, 0, 2, 0;
  CHECK(von_mises(stress) == Approx(2 * std::sqrt(3.0)));
  stress << 5, 5, 5, 0, 0, 0;
  CHECK(von_mises(stress) == 0);
}

TEST_CASE("a rotated stress has the same invariants, and turns with its axes") {
  Vector6 along_x;
  along_x << 1, 0, 0, 0, 0, 0;
  const Mat3 turn = Eigen::AngleAxisd(kPi / 2, Vec3::UnitZ()).toRotationMatrix();
  Vector6 along_y;
  along_y << 0, 1, 0, 0, 0, 0;
  CHECK((rotated(turn, along_x) - along_y).norm() < 1e-15);
  Vector6 any;
  any << 1, -2, 3, 0.5, 4, -1;
  const Mat3 r = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  CHECK(von_mises(rotated(r, any)) == Approx(von_mises(any)));
}
