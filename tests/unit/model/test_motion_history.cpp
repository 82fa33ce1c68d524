#include "model/elastic_system.hpp"
#include "model/precompute.hpp"
#include "support/models.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

BodyModel galerkin_model(const char* scheme, double lam, double window = 1) {
  const Material m = material(1000, 1e6, 0.3);
  const BodyGeometry g = geometry_of(box(Vec3(2, 1, 0.7), {1, 1, 1}), m.density);
  PrecomputeOptions o = options_for(g, m, scheme, lam);
  o.discretisation.method = SpatialMethod::galerkin;
  o.discretisation.quadrature_tolerance = 1e-6;
  o.window = window;
  return precompute(g, o);
}

/// Displacements f(t) in all unknowns at the stages of step n, t in units of dt.
template <class F>
Eigen::MatrixXd stages_of(const BodyModel& model, int n, const F& f) {
  const StageVector& times = model.discretisation.scheme.stage_times();
  Eigen::MatrixXd u(static_cast<Eigen::Index>(3 * model.nodes()), times.size());
  for (Eigen::Index a = 0; a < u.cols(); ++a) u.col(a).setConstant(f(n + times[a] - 1));
  return u;
}

}  // namespace

TEST_CASE("past displacements become accelerations, and go on without any") {
  for (const char* scheme : {"radau2", "radau3", "bdf1", "theta:0.5", "bdf2"}) {
    const BodyModel model = galerkin_model(scheme, 1.5);
    const double dt = model.discretisation.dt;
    MotionHistory steady(model, 1), faster(model, 1);
    for (int n = 1; n <= 8; ++n) {
      steady.push(stages_of(model, n, [](double t) { return 3 + 2 * t; }));
      faster.push(stages_of(model, n, [](double t) { return t * t; }));
    }
    const Eigen::MatrixXd next = stages_of(model, 9, [](double t) { return 3 + 2 * t; });
    CHECK((steady.unaccelerated() - next).cwiseAbs().maxCoeff() < 1e-12);
    const Eigen::MatrixXd right = lag_inputs(model.discretisation.scheme);
    const Eigen::MatrixXd a =
        Eigen::MatrixXd::Constant(next.rows(), model.discretisation.scheme.stages(), 2 / (dt * dt));
    CHECK((faster.lags().lag(1) - a * right).norm() < 1e-9 * (a * right).norm());
    CHECK(steady.lags().lag(1).norm() < 1e-9 * (a * right).norm());
  }
}

TEST_CASE("a step of the inertial form satisfies D(0) u + sum of Z a = frame") {
  const double theta = 0.5;
  const BodyModel model = galerkin_model("theta:0.5", 2.5);
  const ElasticSystem system(model);
  const auto size = static_cast<Eigen::Index>(3 * model.nodes());
  const double dt = model.discretisation.dt, root = 1 + theta / 2;
  // Delta(zeta)^2 by hand: ((1 + t/2) - (1 + t) zeta + t/2 zeta^2)^2
  const double d[] = {root, -(1 + theta), theta / 2};
  double series[5] = {};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) series[i + j] += d[i] * d[j];
  std::vector<Eigen::VectorXd> u;  // newest first
  MotionHistory motion = system.make_motion_history();
  const int history = model.discretisation.history_length;
  for (int k = 0; k < history + 4; ++k) {
    u.insert(u.begin(), Eigen::VectorXd::Random(size));
    motion.push(u[0]);
  }
  std::vector<Eigen::MatrixXd> sums = {Eigen::MatrixXd::Zero(size, 1)};
  system.subtract_motion_history({&motion}, sums);
  const SpectralState state = system.solve(sums, {&motion})[0];
  u.insert(u.begin(), system.displacement_stages(state).col(0));
  const auto acceleration = [&](int lag) {
    Eigen::VectorXd a = Eigen::VectorXd::Zero(size);
    for (int j = 0; j < 5; ++j) a += series[j] / (dt * dt) * u[lag + j];
    return a;
  };
  const Eigen::MatrixXd stiffness = full_matrix(*model.stiffness, 0);
  const Eigen::MatrixXd moved =
      system.frame_balance()->moved(0, Eigen::MatrixXcd::Identity(size, size)).real();
  const Eigen::MatrixXd initial = (full_matrix(*model.inverse[0], 0) + moved).inverse();
  const Eigen::MatrixXd inertia = (initial - stiffness) * (dt * dt / (root * root));
  Eigen::VectorXd forces = inertia * acceleration(0);
  for (int k = 1; k <= history; ++k) forces += full_matrix(*model.h, k - 1) * acceleration(k);
  const Eigen::VectorXd frame = model.initial_body_force[0].real() * -state.acceleration[0].real();
  Eigen::VectorXd stresses = stiffness * u[0];
  // nothing else is left than the net force of D(0) u, which is that of the quadrature
  CHECK((stresses + forces - frame).norm() < 1e-4 * (stresses.norm() + forces.norm()));
  CHECK(frame.norm() > 1e-3 * forces.norm());
}
