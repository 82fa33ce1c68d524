#include "model/growth.hpp"

#include <random>

#include <Eigen/Eigenvalues>

namespace bem {
namespace {

/// The step operator of a free body. A state holds the displacements and the frame's accelerations
/// (times dt^2) of all steps that the history reaches back to, newest first.
class FreeRecursion {
 public:
  explicit FreeRecursion(const BodyModel& model)
      : system_(model),
        unknowns_(static_cast<Eigen::Index>(3 * model.nodes())),
        stages_(model.discretisation.scheme.stages()),
        length_(model.discretisation.history_length),
        dt_(model.discretisation.dt) {}

  Eigen::Index size() const { return length_ * step_size(); }

  Eigen::VectorXd apply(const Eigen::VectorXd& state) const {
    const Scheme& scheme = system_.scheme();
    LagHistory u(scheme, unknowns_, length_, 1), a(scheme, 6, length_, 1);
    for (int k = length_; k >= 1; --k) {
      const double* step = state.data() + (k - 1) * step_size();
      u.push(Eigen::Map<const Eigen::MatrixXd>(step, unknowns_, stages_));
      a.push(Eigen::Map<const Eigen::MatrixXd>(step + unknowns_ * stages_, 6, stages_) /
             (dt_ * dt_));
    }
    std::vector<Eigen::MatrixXd> sums = {Eigen::MatrixXd::Zero(
        unknowns_, static_cast<Eigen::Index>(scheme.lag_components().size()))};
    system_.subtract_displacement_history({&u}, sums);
    system_.add_input_history(system_.body_force(), a, sums[0]);
    const SpectralState next = system_.solve(sums)[0];
    Eigen::VectorXd out(size());
    Eigen::Map<Eigen::MatrixXd>(out.data(), unknowns_, stages_) = system_.displacement_stages(next);
    Eigen::Map<Eigen::MatrixXd>(out.data() + unknowns_ * stages_, 6, stages_) =
        dt_ * dt_ * system_.acceleration_stages(next);
    out.tail(size() - step_size()) = state.head(size() - step_size());
    return out;
  }

 private:
  Eigen::Index step_size() const { return (unknowns_ + 6) * stages_; }

  ElasticSystem system_;
  Eigen::Index unknowns_, stages_;
  int length_;
  double dt_;
};

/// Largest Ritz value of a Hessenberg matrix among those whose residual is at most `tolerance`.
GrowthEstimate largest_ritz_value(const Eigen::MatrixXd& hessenberg, double next,
                                  double tolerance) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(hessenberg);
  GrowthEstimate best;
  best.residual = 1;
  for (Eigen::Index i = 0; i < hessenberg.rows(); ++i) {
    const Eigen::VectorXcd v = solver.eigenvectors().col(i);
    const double residual = std::abs(next * v[v.size() - 1]) / v.norm();
    const double size = std::abs(solver.eigenvalues()[i]);
    if (residual <= tolerance && size > best.factor) {
      best.factor = size;
      best.residual = residual;
    }
  }
  return best;
}

}  // namespace

GrowthEstimate growth_factor(const BodyModel& model) {
  constexpr int kMostSteps = 160, kCheckEvery = 20;
  constexpr double kTolerance = 1e-5;
  const FreeRecursion recursion(model);
  Eigen::VectorXd start(recursion.size());
  std::mt19937 random(1);  // the same numbers on every machine
  for (Eigen::Index i = 0; i < start.size(); ++i) start[i] = random() / 4294967296.0 - 0.5;
  // a few steps fill the history with a consistent motion and damp what is heavily damped
  const int smoothing = model.discretisation.history_length + 10;
  for (int i = 0; i < smoothing; ++i) {
    start = recursion.apply(start);
    start.normalize();
  }
  std::vector<Eigen::VectorXd> basis = {start};
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(kMostSteps + 1, kMostSteps);
  GrowthEstimate best;
  for (int j = 0; j < kMostSteps; ++j) {
    Eigen::VectorXd w = recursion.apply(basis[j]);
    for (int pass = 0; pass < 2; ++pass)
      for (int i = 0; i <= j; ++i) {
        const double c = basis[i].dot(w);
        h(i, j) += c;
        w -= c * basis[i];
      }
    h(j + 1, j) = w.norm();
    const bool exhausted = h(j + 1, j) < 1e-12;
    if (exhausted || (j + 1) % kCheckEvery == 0) {
      const GrowthEstimate loose =
          largest_ritz_value(h.topLeftCorner(j + 1, j + 1), h(j + 1, j), 1);
      best = largest_ritz_value(h.topLeftCorner(j + 1, j + 1), h(j + 1, j), kTolerance);
      best.steps = smoothing + j + 1;
      // done when nothing unconverged is larger
      if (exhausted || (best.factor > 0 && loose.factor <= best.factor * (1 + 1e-6))) return best;
      if (j + 1 == kMostSteps && best.factor == 0) best = loose;
    }
    basis.push_back(w / h(j + 1, j));
  }
  best.steps = smoothing + kMostSteps;
  return best;
}

}  // namespace bem
