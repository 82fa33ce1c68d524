#include "base/symmetric_matrix.hpp"
#include "support/bodies.hpp"
#include "support/laplace_assembly.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

/// Largest residual of H u = G p + s^2 C strain for a displacement of uniform strain, which is
/// dynamic with the body force rho s^2 u, relative to |u|  (M40), (M7).
double patch_residual(const TriangleMesh& mesh, const Material& m, Complex s, double tolerance) {
  Mat3 a;
  a << 0.3, -0.2, 0.5, 0.1, 0.4, -0.3, 0.2, 0.6, -0.1;
  if (s != 0.0) a = Mat3(0.5 * (a + a.transpose()));
  if (m.poisson_ratio == 0.5) a -= a.trace() / 3 * Mat3::Identity();
  const Mat3 strain = 0.5 * (a + a.transpose());
  const double lambda = m.poisson_ratio == 0.5
                            ? 0
                            : 2 * m.shear_modulus * m.poisson_ratio / (1 - 2 * m.poisson_ratio);
  const Mat3 stress = 2 * m.shear_modulus * strain + lambda * strain.trace() * Mat3::Identity();
  const Vec3 shift = s == 0.0 ? Vec3(0.1, 0.2, -0.3) : Vec3(Vec3::Zero());
  Eigen::VectorXcd u(3 * mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    u.segment<3>(3 * i) = (a * mesh.vertices[i] + shift).cast<Complex>();
  std::vector<std::array<Eigen::Vector3cd, 3>> tractions;
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3cd p = (stress * triangle_normal(mesh, t)).cast<Complex>();
    tractions.push_back({p, p, p});
  }
  const LaplaceMatrices matrices = laplace_matrices(mesh, m, s, tolerance);
  const Eigen::VectorXcd load = laplace_corner_load(mesh, m, s, tolerance, tractions) +
                                s * s * (matrices.c * symmetric_entries(strain));
  return (matrices.h * u - load).cwiseAbs().maxCoeff() / u.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("uniform strain satisfies the static equation exactly on flat-triangle meshes") {
  const std::pair<const char*, TriangleMesh> bodies[] = {
      {"icosphere", centred(icosphere(1, 0.7))},
      {"cube", centred(box(Vec3(1, 1, 1), {3, 3, 3}))},
      {"tetrahedron", centred(random_tetrahedron(7))},
      {"star", centred(star(1, 1))},
      {"notched cube", centred(notched_cube(1, 2))}};
  for (double nu : {0.0, 0.3, 0.5})
    for (const auto& [name, mesh] : bodies) {
      INFO(name << ", nu " << nu);
      const double residual = patch_residual(mesh, material(1.3, 2.1, nu), 0, 1e-7);
      CHECK(residual < 1e-8);
      CHECK(residual > 1e-16);
    }
}

TEST_CASE("uniform strain with the body force of its inertia is exact for any s") {
  for (double nu : {0.0, 0.3, 0.5})
    for (const TriangleMesh& mesh : {centred(star(1, 1)), centred(random_tetrahedron(7))})
      for (Complex s : {Complex(1, 2), Complex(4, -3)}) {
        const double residual = patch_residual(mesh, material(1.3, 2.1, nu), s, 1e-7);
        INFO("nu " << nu << ", s " << s);
        CHECK(residual < 2e-6);
        CHECK(residual > 1e-16);
      }
}

TEST_CASE("the columns of the centrifugal force are continuous at nu = 0.5") {
  const TriangleMesh mesh = centred(star(1, 1));
  const auto columns = [&](double nu) {
    return laplace_matrices(mesh, material(1.3, 2.1, nu), Complex(1, 2), 1e-7).c;
  };
  const Eigen::MatrixXcd limit = columns(0.5);
  CHECK((columns(0.4999999) - limit).norm() < 1e-5 * limit.norm());
  CHECK((columns(0.49) - limit).norm() > 1e-3 * limit.norm());
}

TEST_CASE("rigid motion is reproduced by the body-force columns for any s") {
  const TriangleMesh mesh = centred(star(1, 1));
  for (double nu : {0.0, 0.3, 0.5})
    for (Complex s : {Complex(1, 2), Complex(4, -3)}) {
      const LaplaceMatrices m = laplace_matrices(mesh, material(1.3, 2.1, nu), s, 1e-8);
      const Eigen::MatrixXcd t = m.h * translations(mesh) + s * s * m.d;
      const Eigen::MatrixXcd r = m.h * rotations(mesh) + s * s * m.q;
      CHECK(t.cwiseAbs().maxCoeff() < 2e-6);
      CHECK(r.cwiseAbs().maxCoeff() < 2e-6);
    }
}
