// Plane waves inside a body: the displacements that H(s) u = G(s) p gives for the exact tractions.
#include "support/bodies.hpp"
#include "support/laplace_assembly.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

enum class Wave { pressure, shear };

/// u = d exp(-s k.x/c) with d along the direction of travel k, or across it.
struct PlaneWave {
  PlaneWave(Wave wave, const Vec3& direction, const Material& m, Complex s)
      : k(direction.normalized()) {
    d = wave == Wave::pressure ? k : Vec3(k.cross(Vec3(0, 1, 0)).normalized());
    const double c2 = m.shear_speed();
    slowness = s / (wave == Wave::pressure ? c2 / std::sqrt(m.kappa()) : c2);
    // Hooke's law; shear waves have no dilatation, whatever lambda is
    const double mu = m.shear_modulus;
    const double lambda = wave == Wave::pressure ? mu * (1 / m.kappa() - 2) : 0;
    stress = mu * (d * k.transpose() + k * d.transpose()) + lambda * d.dot(k) * Mat3::Identity();
  }
  Eigen::Vector3cd displacement(const Vec3& x) const { return d * phase(x); }
  Eigen::Vector3cd traction(const Vec3& x, const Vec3& n) const {
    return -slowness * phase(x) * (stress * n);
  }
  Complex phase(const Vec3& x) const { return std::exp(-slowness * k.dot(x)); }

  Vec3 k, d;
  Mat3 stress;
  Complex slowness;
};

/// Relative error of the nodal displacements, waves that share one matrix.
std::vector<double> wave_errors(const char* name, const TriangleMesh& mesh, double nu, Complex s,
                                const std::vector<Wave>& waves,
                                const Vec3& direction = Vec3(1, 2, 3)) {
  const Material m = material(1.3, 2.1, nu);
  constexpr double kTolerance = 1e-6;
  const LaplaceMatrices matrices = laplace_matrices(mesh, m, s, kTolerance);
  const Eigen::PartialPivLU<Eigen::MatrixXcd> factors(matrices.h);
  std::vector<double> errors;
  for (Wave wave : waves) {
    const PlaneWave exact(wave, direction, m, s);
    std::vector<std::array<Eigen::Vector3cd, 3>> tractions;
    for (const Triangle& t : mesh.triangles) {
      const Vec3 n = triangle_normal(mesh, t);
      tractions.push_back({exact.traction(mesh.vertices[t[0]], n),
                           exact.traction(mesh.vertices[t[1]], n),
                           exact.traction(mesh.vertices[t[2]], n)});
    }
    Eigen::VectorXcd u(3 * mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      u.segment<3>(3 * i) = exact.displacement(mesh.vertices[i]);
    const Eigen::VectorXcd load = laplace_corner_load(mesh, m, s, kTolerance, tractions);
    errors.push_back((factors.solve(load) - u).norm() / u.norm());
    std::printf("plane %s wave, %s %zu vertices, nu %.2f, s = %.0f+%.0fi: error %.2e\n",
                wave == Wave::pressure ? "P" : "S", name, mesh.vertices.size(), nu, s.real(),
                s.imag(), errors.back());
  }
  return errors;
}

const std::vector<Wave> kBoth = {Wave::pressure, Wave::shear};

TriangleMesh sphere(int level) {
  return icosphere(level, 1);
}
TriangleMesh cube(int level) {
  return box(Vec3(1, 1, 1), {1 << level, 1 << level, 1 << level});
}

/// Limits for the waves of one run: 1.1 times the errors of an independent implementation.
void check_errors(const char* name, const TriangleMesh& mesh, double nu, Complex s,
                  const std::vector<Wave>& waves, const std::vector<double>& references) {
  const std::vector<double> errors = wave_errors(name, mesh, nu, s, waves);
  for (std::size_t w = 0; w < waves.size(); ++w) CHECK(errors[w] < 1.1 * references[w]);
}

}  // namespace

TEST_CASE("plane waves in a sphere") {
  for (int level : {1, 2}) {
    const TriangleMesh mesh = sphere(level);
    const int i = level - 1;
    const double pressure[] = {1.2e-2, 3.7e-3}, shear[] = {4.1e-2, 1.25e-2};
    check_errors("sphere", mesh, 0.3, {1, 2}, kBoth, {pressure[i], shear[i]});
    const double fast_shear[] = {9.4e-2, 3.2e-2};
    check_errors("sphere", mesh, 0.3, {6, 3}, {Wave::shear}, {fast_shear[i]});
    const double pressure_without_contraction[] = {2.4e-2, 7.4e-3};
    check_errors("sphere", mesh, 0, {1, 2}, {Wave::pressure}, {pressure_without_contraction[i]});
    const double incompressible_shear[] = {4.7e-2, 1.45e-2};
    check_errors("sphere", mesh, 0.5, {1, 2}, {Wave::shear}, {incompressible_shear[i]});
  }
}

TEST_CASE("plane waves in a cube") {
  for (int level : {1, 2}) {
    const double pressure[] = {1.9e-2, 5.9e-3}, shear[] = {6.8e-2, 2.3e-2};
    check_errors("cube", cube(level), 0.3, {1, 2}, kBoth, {pressure[level - 1], shear[level - 1]});
  }
}

TEST_CASE("plane waves converge with order 1.7 at least", "[.][long]") {
  const std::tuple<const char*, TriangleMesh (*)(int), std::vector<double>> bodies[] = {
      {"sphere", sphere, {1.05e-3, 3.5e-3}}, {"cube", cube, {1.7e-3, 6.9e-3}}};
  for (const auto& [name, make, references] : bodies) {
    const std::vector<double> coarse = wave_errors(name, make(2), 0.3, {1, 2}, kBoth);
    const std::vector<double> fine = wave_errors(name, make(3), 0.3, {1, 2}, kBoth);
    for (std::size_t w = 0; w < kBoth.size(); ++w) {
      const double order = std::log2(coarse[w] / fine[w]);
      std::printf("order %.2f\n", order);
      CHECK(order > 1.7);
      CHECK(fine[w] < 1.1 * references[w]);
    }
  }
}

TEST_CASE("short plane waves on finer meshes, and their direction", "[.][long]") {
  check_errors("sphere", sphere(3), 0.3, {6, 3}, {Wave::shear}, {9.3e-3});
  std::vector<double> errors;
  for (int level : {1, 2, 3})
    errors.push_back(wave_errors("cube", cube(level), 0.3, {6, 3}, {Wave::shear})[0]);
  CHECK(errors[0] > 1.8 * errors[1]);
  CHECK(errors[1] > 2.3 * errors[2]);
  for (const Vec3& k : {Vec3(1, 0.4, 0.2), Vec3(1, 0, 0), Vec3(1, 1, 1)})
    CHECK(wave_errors("cube", cube(2), 0.3, {6, 3}, {Wave::shear}, k)[0] < 0.15);
}
