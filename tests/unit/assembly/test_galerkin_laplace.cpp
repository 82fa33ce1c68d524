#include "base/symmetric_matrix.hpp"
#include "support/bodies.hpp"
#include "support/galerkin_laplace.hpp"
#include "support/reference.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

Eigen::Matrix3cd matrix(const json& j) {
  Eigen::Matrix3cd m;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      m(r, c) = j[r][c].is_array() ? complex(j[r][c]) : Complex(number(j[r][c]));
  return m;
}

double difference(const Eigen::Matrix3cd& found, const json& expected) {
  return (found - matrix(expected)).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("pairs of triangles agree with the reference, touching or not") {
  const json data = load_reference("discretisation.json")["triangle_pairs"];
  double worst = 0, worst_adjoint = 0;
  for (const json& p : data["values"]) {
    const json& geometry = data["geometry"][p["kind"].get<std::string>()];
    TriangleMesh mesh;
    for (const json& v : geometry["vertices"]) mesh.vertices.push_back(vec3(v));
    for (const char* name : {"X", "Y"})
      mesh.triangles.push_back({geometry[name][0], geometry[name][1], geometry[name][2]});
    const Complex s = complex(p["s"]);
    const PairMatrices found =
        galerkin_laplace_pair(mesh, material(1, 1, number(p["nu"])), s, 1e-8, 0, 1);
    INFO(p["kind"] << ", nu " << p["nu"] << ", s " << p["s"]);
    const auto block = [](const auto& m, const std::string& at) {
      return Eigen::Matrix3cd(
          m.template block<3, 3>(3 * (at[0] - '0'), 3 * (at[1] - '0')).template cast<Complex>());
    };
    double error = 0, adjoint = 0;
    for (const auto& [at, value] : p["D0"].items())
      error = std::max(error, difference(block(found.static_h, at), value));
    for (const auto& [at, value] : p["Z"].items())
      error = std::max(error, difference(block(found.inertia, at), value));
    for (const auto& [at, value] : p["Kprime"].items())
      adjoint = std::max(adjoint, difference(block(found.adjoint, at), value));
    CHECK(error < 1e-6);
    CHECK(adjoint < 2e-6);
    worst = std::max(worst, error);
    worst_adjoint = std::max(worst_adjoint, adjoint);
  }
  std::printf("pairs of triangles: D(0), Z %.1e, K' %.1e\n", worst, worst_adjoint);
}

TEST_CASE("the contracted operator of an icosphere agrees with the reference") {
  const json data = load_reference("discretisation.json")["icosphere42_contracted_D"];
  TriangleMesh mesh;
  for (const json& v : data["vertices"]) mesh.vertices.push_back(vec3(v));
  for (const json& t : data["triangles"]) mesh.triangles.push_back({t[0], t[1], t[2]});
  const EdgeReconstruction reconstruction(mesh);
  for (const json& p : data["values"]) {
    if (complex(p["s"]) == 0.0 && number(p["nu"]) != 0.3) continue;  // part of the others
    const LaplaceMatrices found = galerkin_laplace_matrices(
        mesh, reconstruction, material(1, 1, number(p["nu"])), complex(p["s"]), 1e-6);
    double worst = 0;
    for (const auto& [at, value] : p["blocks"].items()) {
      const int a = std::stoi(at), b = std::stoi(at.substr(at.find(',') + 1));
      worst = std::max(worst, difference(found.h.block<3, 3>(3 * a, 3 * b), value));
    }
    std::printf("icosphere, nu %.1f, s %s: %.1e\n", number(p["nu"]), p["s"].dump().c_str(), worst);
    CHECK(worst < 2e-6);
    CHECK((found.h - found.h.transpose()).cwiseAbs().maxCoeff() < 1e-13);
  }
}

TEST_CASE("the Galerkin equations hold exactly for rigid motions and uniform strain") {
  const TriangleMesh bodies[] = {centred(icosphere(1, 1)), centred(random_tetrahedron(7))};
  for (double nu : {0.3, 0.5})
    for (const TriangleMesh& mesh : bodies) {
      if (nu == 0.5 && mesh.vertices.size() > 4) continue;  // takes half a minute
      const Material m = material(1.3, 2.1, nu);
      // dynamic parts are integrated with fewer points than static ones
      constexpr double tolerance = 5e-6, inertia_tolerance = 2e-5;
      const auto n = static_cast<Eigen::Index>(3 * mesh.vertices.size());
      const EdgeReconstruction reconstruction(mesh);
      const MassProperties mass = mass_properties(mesh, m.density);
      Eigen::MatrixXcd rigid(n, 6);
      for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        rigid.block<3, 3>(3 * i, 0) = Mat3::Identity().cast<Complex>();
        rigid.block<3, 3>(3 * i, 3) = -cross_matrix(mesh.vertices[i]).cast<Complex>();
      }
      const LaplaceMatrices rest = galerkin_laplace_matrices(mesh, reconstruction, m, 0, 1e-6);
      const double scale = rest.h.cwiseAbs().maxCoeff();
      CHECK((rest.h * rigid.leftCols<3>()).cwiseAbs().maxCoeff() < 1e-13 * scale);
      CHECK((rest.h * rigid.rightCols<3>()).cwiseAbs().maxCoeff() < 1e-6 * scale);
      // R^T Z(0) R: mass and inertia
      const Eigen::MatrixXcd masses = -rigid.transpose() * rest.d;
      CHECK((masses.topRows<3>() - mass.mass * Mat3::Identity().cast<Complex>())
                .cwiseAbs()
                .maxCoeff() < inertia_tolerance * mass.mass);
      const Eigen::MatrixXcd inertia = -rigid.rightCols<3>().transpose() * rest.q;
      CHECK((inertia - mass.inertia.cast<Complex>()).cwiseAbs().maxCoeff() <
            inertia_tolerance * mass.inertia.cwiseAbs().maxCoeff());

      for (const Complex s : {Complex(0), Complex(3, -2)}) {
        Mat3 a;
        a << 0.3, -0.2, 0.5, -0.2, 0.4, 0.6, 0.5, 0.6, -0.1;
        if (nu == 0.5) a -= a.trace() / 3 * Mat3::Identity();
        const double lambda = nu == 0.5 ? 0 : 2 * m.shear_modulus * nu / (1 - 2 * nu);
        const Mat3 stress = 2 * m.shear_modulus * a + lambda * a.trace() * Mat3::Identity();
        Eigen::VectorXcd u(n);
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
          u.segment<3>(3 * i) = (a * mesh.vertices[i]).cast<Complex>();
        std::vector<std::array<Eigen::Vector3cd, 3>> tractions;
        for (const Triangle& t : mesh.triangles) {
          const Eigen::Vector3cd p = (stress * triangle_normal(mesh, t)).cast<Complex>();
          tractions.push_back({p, p, p});
        }
        const LaplaceMatrices l = galerkin_laplace_matrices(mesh, reconstruction, m, s, 1e-6);
        const Eigen::VectorXcd load =
            galerkin_corner_load(mesh, reconstruction, m, s, 1e-6, tractions) +
            s * s * (l.c * symmetric_entries(a));
        const double residual = (l.h * u - load).cwiseAbs().maxCoeff() / load.cwiseAbs().maxCoeff();
        std::printf("Galerkin, %zu vertices, nu %.1f, s (%g, %g): patch test %.1e\n",
                    mesh.vertices.size(), nu, s.real(), s.imag(), residual);
        CHECK(residual < tolerance);
      }
    }
}
