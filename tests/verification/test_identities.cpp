// Identities that hold on every closed flat-triangle mesh at any resolution, up to the error of the
// quadrature: uniform strain (M40), rigid translation and rotation (M41)-(M43).
#include "support/bodies.hpp"
#include "support/lag_matrices.hpp"
#include "support/laplace_assembly.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

const double kPoissonRatios[] = {0, 0.3, 0.49, 0.5};

/// Residuals relative to the largest entry of the term on the other side.
struct Residuals {
  double strain = 0, translation = 0, rotation = 0;
  double worst() const { return std::max({strain, translation, rotation}); }
};

Residuals worst_of(const Residuals& a, const Residuals& b) {
  return {std::max(a.strain, b.strain), std::max(a.translation, b.translation),
          std::max(a.rotation, b.rotation)};
}

double largest(const Eigen::MatrixXcd& m) {
  return m.cwiseAbs().maxCoeff();
}

/// H(0) u - G(0) p for u = A x + b with the traction of every triangle  (M40).
double strain_residual(const TriangleMesh& mesh, const Material& m, double tolerance) {
  Mat3 a;
  a << 0.3, -0.2, 0.5, 0.1, 0.4, -0.3, 0.2, 0.6, -0.1;
  const bool incompressible = m.poisson_ratio == 0.5;
  if (incompressible) a -= a.trace() / 3 * Mat3::Identity();
  const Mat3 strain = 0.5 * (a + a.transpose());
  const double lambda =
      incompressible ? 0 : 2 * m.shear_modulus * m.poisson_ratio / (1 - 2 * m.poisson_ratio);
  const Mat3 stress = 2 * m.shear_modulus * strain + lambda * strain.trace() * Mat3::Identity();
  Eigen::VectorXcd u(3 * mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    u.segment<3>(3 * i) = (a * mesh.vertices[i] + Vec3(0.1, 0.2, -0.3)).cast<Complex>();
  std::vector<std::array<Eigen::Vector3cd, 3>> tractions;
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3cd p = (stress * triangle_normal(mesh, t)).cast<Complex>();
    tractions.push_back({p, p, p});
  }
  const LaplaceMatrices matrices = laplace_matrices(mesh, m, 0, tolerance);
  return largest(matrices.h * u - laplace_corner_load(mesh, m, 0, tolerance, tractions)) /
         largest(u);
}

/// H(s) T + s^2 D(s) and H(s) W + s^2 Q(s)  (M41), (M42).
Residuals rigid_residuals(const TriangleMesh& mesh, const Material& m, Complex s,
                          double tolerance) {
  const LaplaceMatrices l = laplace_matrices(mesh, m, s, tolerance);
  Residuals r;
  r.translation = largest(l.h * translations(mesh) + s * s * l.d) / largest(s * s * l.d);
  r.rotation = largest(l.h * rotations(mesh) + s * s * l.q) / largest(s * s * l.q);
  return r;
}

/// All three on one mesh, s of |z| = 2 to 7 across the body; printed and returned.
Residuals laplace_residuals(const char* name, const TriangleMesh& mesh, double nu,
                            double tolerance) {
  const Material m = material(1.3, 2.1, nu);
  const double per_length = m.shear_speed() / diameter(mesh.vertices);
  Residuals r;
  r.strain = strain_residual(mesh, m, tolerance);
  for (Complex s : {per_length * Complex(1, 2), per_length * Complex(5, -5)})
    r = worst_of(r, rigid_residuals(mesh, m, s, tolerance));
  std::printf(
      "identities %-13s %4zu vertices, nu %.2f, tolerance %.0e: strain %.1e translation "
      "%.1e rotation %.1e\n",
      name, mesh.vertices.size(), nu, tolerance, r.strain, r.translation, r.rotation);
  return r;
}

/// Coefficients of Delta(zeta)^2 from the definition of the scheme.
std::vector<StageMatrix> squared_symbol(const Scheme& scheme) {
  std::vector<StageMatrix> delta;
  if (scheme.is_multistep()) {
    const double theta = scheme.theta();
    for (double c : {1 + theta / 2, -1 - theta, theta / 2})
      delta.push_back(StageMatrix::Constant(1, 1, c));
  } else {
    StageMatrix last = StageMatrix::Zero(scheme.stages(), scheme.stages());
    last.col(scheme.stages() - 1).setOnes();
    const StageMatrix inverse = scheme.integration().inverse();
    delta = {inverse, -inverse * last};
  }
  std::vector<StageMatrix> square(2 * delta.size() - 1,
                                  StageMatrix::Zero(scheme.stages(), scheme.stages()));
  for (std::size_t i = 0; i < delta.size(); ++i)
    for (std::size_t j = 0; j < delta.size(); ++j) square[i + j] += delta[i] * delta[j];
  return square;
}

/// Largest entry of H_k V + sum_m (Delta^2)_m B_{k-m}/dt^2 over all lags, for the rigid motions V
/// and body-force columns B (M43), relative to the largest sum_m |(Delta^2)_m| |B_{k-m}|/dt^2: the
/// weights grow with the number of stages and with lam, up to 154 for radau3 at lam = 10.
double lag_residual(const Discretisation& d, const std::vector<Eigen::MatrixXd>& h,
                    const Eigen::MatrixXd& motion, const std::vector<Eigen::MatrixXd>& body) {
  const LaneLayout layout(d.scheme, d.history_length);
  const std::vector<StageMatrix> square = squared_symbol(d.scheme);
  std::vector<Eigen::MatrixXd> moved;
  for (const Eigen::MatrixXd& lane : h) moved.push_back(lane * motion);
  std::vector<double> lanes(layout.count());
  const auto stages = [&](const std::vector<Eigen::MatrixXd>& x, Eigen::Index r, Eigen::Index c,
                          int k) {
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) lanes[lane] = x[lane](r, c);
    return stage_matrix(d.scheme, layout, lanes.data(), k);
  };
  double worst = 0, largest = 0;
  std::vector<StageMatrix> weights(layout.last_lag + 1);
  for (Eigen::Index r = 0; r < moved[0].rows(); ++r)
    for (Eigen::Index c = 0; c < 3; ++c) {
      for (int k = 0; k <= layout.last_lag; ++k) weights[k] = stages(body, r, c, k);
      for (int k = 0; k <= layout.last_lag; ++k) {
        StageMatrix sum = stages(moved, r, c, k);
        StageMatrix terms = StageMatrix::Zero(sum.rows(), sum.cols());
        for (int m = 0; m < static_cast<int>(square.size()) && m <= k; ++m) {
          sum += square[m] * weights[k - m] / (d.dt * d.dt);
          terms += square[m].cwiseAbs() * weights[k - m].cwiseAbs() / (d.dt * d.dt);
        }
        worst = std::max(worst, sum.cwiseAbs().maxCoeff());
        largest = std::max(largest, terms.maxCoeff());
      }
    }
  return worst / largest;
}

/// A discretisation of nu = 0.3 whose history is long enough to hold every weight above 1e-14.
Discretisation full_history(const TriangleMesh& mesh, const char* scheme, double lam,
                            double tolerance) {
  Discretisation d;
  d.material = material(1.3, 2.1, 0.3);
  d.scheme = Scheme::parse(scheme);
  d.dt = diameter(mesh.vertices) / (lam * d.material.shear_speed());
  d.history_length = history_length_for_tolerance(d.scheme, lam, 1e-14);
  d.quadrature_tolerance = tolerance;
  return d;
}

struct LagResiduals {
  double translation, rotation, fixed_translation, fixed_rotation;
};

LagResiduals lag_residuals(const TriangleMesh& mesh, const char* scheme, double lam,
                           double tolerance) {
  const Discretisation d = full_history(mesh, scheme, lam, tolerance);
  const LagMatrices raw = assemble_all(mesh, d, false), fixed = assemble_all(mesh, d, true);
  const LagResiduals r = {lag_residual(d, raw.h, translations(mesh), raw.d),
                          lag_residual(d, raw.h, rotations(mesh), raw.q),
                          lag_residual(d, fixed.h, translations(mesh), fixed.d),
                          lag_residual(d, fixed.h, rotations(mesh), fixed.q)};
  std::printf(
      "lags %-10s lam %4.1f, %2d lags, tolerance %.0e: translation %.1e rotation %.1e, "
      "own blocks fixed: %.1e %.1e\n",
      scheme, lam, d.history_length, tolerance, r.translation, r.rotation, r.fixed_translation,
      r.fixed_rotation);
  return r;
}

void check_laplace_identities(const char* name, const TriangleMesh& mesh, double nu) {
  INFO(name << ", nu " << nu);
  const Residuals loose = laplace_residuals(name, mesh, nu, 1e-6);
  const Residuals tight = laplace_residuals(name, mesh, nu, 1e-8);
  CHECK(loose.worst() < 1e-6);
  CHECK(tight.worst() < 1e-8);
  CHECK(tight.worst() < 0.05 * loose.worst());
}

/// The direct own blocks leave the error of the quadrature; after the fix translation is exact to
/// rounding, and rotation keeps an error of the same size.
void check_lag_identities(const char* scheme, double lam, double tolerance) {
  INFO(scheme << ", lam " << lam << ", tolerance " << tolerance);
  const LagResiduals r = lag_residuals(centred(icosphere(1, 1)), scheme, lam, tolerance);
  CHECK(r.translation < 0.2 * tolerance);
  CHECK(r.rotation < 0.5 * tolerance);
  CHECK(r.translation > 1e-5 * tolerance);
  CHECK(r.fixed_translation < 1e-13);
  CHECK(r.fixed_rotation < 0.5 * tolerance);
}

}  // namespace

TEST_CASE("uniform strain and rigid motion are exact up to the quadrature") {
  const std::pair<const char*, TriangleMesh> bodies[] = {
      {"icosphere", centred(icosphere(1, 1))},
      {"cube", centred(box(Vec3(1, 1, 1), {3, 3, 3}))},
      {"tetrahedron", centred(random_tetrahedron(7))}};
  for (const auto& [name, mesh] : bodies)
    for (double nu : kPoissonRatios) check_laplace_identities(name, mesh, nu);
  check_laplace_identities("star", centred(star(2, 1)), 0.3);
}

TEST_CASE("uniform strain and rigid motion on larger meshes", "[.][long]") {
  const std::pair<const char*, TriangleMesh> bodies[] = {{"icosphere", centred(icosphere(2, 1))},
                                                         {"star", centred(star(2, 1))},
                                                         {"icosphere", centred(icosphere(3, 1))}};
  for (const auto& [name, mesh] : bodies)
    for (double nu : kPoissonRatios) check_laplace_identities(name, mesh, nu);
}

TEST_CASE("the weights of every lag satisfy the identities of rigid motion") {
  for (const char* scheme : {"bdf1", "theta:0.75", "bdf2", "radau2", "radau3"}) {
    check_lag_identities(scheme, 4, 1e-6);
    check_lag_identities(scheme, 4, 1e-8);
  }
}

TEST_CASE("the weights of every lag, short and long time steps", "[.][long]") {
  for (const char* scheme : {"bdf1", "theta:0.75", "bdf2", "radau2", "radau3"})
    for (double lam : {2.0, 10.0}) {
      check_lag_identities(scheme, lam, 1e-6);
      check_lag_identities(scheme, lam, 1e-8);
    }
}

TEST_CASE("with a short history, the closure keeps rigid translation exact") {
  const TriangleMesh mesh = centred(star(1, 1));
  for (const char* scheme : {"bdf1", "radau2"}) {
    Discretisation d = full_history(mesh, scheme, 4, 1e-6);
    d.history_length = default_history_length(d.scheme, 4);
    const LaneLayout layout(d.scheme, d.history_length);
    const std::vector<double> factors = static_lane_factors(d.scheme, layout);
    const auto at_rest = [&](const LagMatrices& m) {
      Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3 * mesh.vertices.size(), 3);
      for (int lane = 0; lane < layout.count(); ++lane)
        sum += factors[lane] * m.h[lane] * translations(mesh);
      return sum.cwiseAbs().maxCoeff();
    };
    INFO(scheme);
    CHECK(at_rest(assemble_all(mesh, d, true)) < 1e-12);
    const double quadrature = at_rest(assemble_all(mesh, d, false));
    CHECK(quadrature < 1e-6);
    CHECK(quadrature > 1e-12);
  }
}
