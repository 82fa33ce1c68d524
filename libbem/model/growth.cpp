#include "model/growth.hpp"

#include "algebra/decompositions.hpp"
#include "model/rigid_projection.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <random>

namespace bem {
namespace {

/// The step operator of a free body. A state holds the displacements and the frame's accelerations
/// (times dt^2) of all steps that the history reaches back to, newest first.
class FreeRecursion {
 public:
  explicit FreeRecursion(const BodyModel& model)
      : system_(model, 1),
        unknowns_(static_cast<Eigen::Index>(3 * model.nodes())),
        stages_(model.discretisation.scheme.stages()),
        length_(system_.make_motion_history().reach()),
        dt_(model.discretisation.dt) {
    if (!model.stiffness) return;
    rigid_modes_ = orthonormal_rigid_modes(model.geometry.nodes);
    const Eigen::MatrixXd& rigid = system_.projection().rigid();
    rigid_part_ = inverse(rigid * rigid_modes_) * rigid;
  }

  Eigen::Index size() const { return length_ * step_size(); }

  /// Takes the rigid motion out of a state. In the inertial form it would go on for ever, and a
  /// motion that grows evenly hides factors close to 1; the recursion adds none.
  void remove_rigid_motion(Eigen::VectorXd& state) const {
    if (rigid_modes_.size() == 0) return;
    for (int k = 0; k < length_; ++k) {
      Eigen::Map<Eigen::MatrixXd> u(state.data() + k * step_size(), unknowns_, stages_);
      u -= rigid_modes_ * (rigid_part_ * u);
    }
  }

  Eigen::VectorXd apply(const Eigen::VectorXd& state) const {
    const Scheme& scheme = system_.scheme();
    MotionHistory u = system_.make_motion_history();
    LagHistory a = system_.make_history(6);
    for (int k = length_; k >= 1; --k) {
      const double* step = state.data() + (k - 1) * step_size();
      u.push(Eigen::Map<const Eigen::MatrixXd>(step, unknowns_, stages_));
      a.push(Eigen::Map<const Eigen::MatrixXd>(step + unknowns_ * stages_, 6, stages_) /
             (dt_ * dt_));
    }
    std::vector<Eigen::MatrixXd> sums = {Eigen::MatrixXd::Zero(
        unknowns_, static_cast<Eigen::Index>(scheme.lag_components().size()))};
    system_.subtract_motion_history({&u}, sums);
    system_.add_input_history(system_.body_force(), a, sums[0]);
    const SpectralState next = system_.solve(sums, {&u})[0];
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
  Eigen::MatrixXd rigid_modes_, rigid_part_;  ///< 3N x 6, 6 x 3N: coordinates of the rigid part
};

/// A space of states and the recursion restricted to it, extended step by step (Arnoldi iteration)
/// and cut back to its largest motions when it has become big (Krylov-Schur restart).
class KrylovSpace {
 public:
  KrylovSpace(const FreeRecursion& recursion, const Eigen::VectorXd& start, int most)
      : recursion_(recursion),
        basis_{start.normalized()},
        restricted_(Eigen::MatrixXd::Zero(most + 1, most)) {}

  int size() const { return static_cast<int>(basis_.size()) - 1; }

  /// One more step. False if the space is closed: its eigenvalues are then exact.
  bool extend() {
    constexpr double kClosed = 1e-12;
    const int j = size();
    Eigen::VectorXd w = recursion_.apply(basis_[j]);
    for (int pass = 0; pass < 2; ++pass)
      for (int i = 0; i <= j; ++i) {
        const double c = basis_[i].dot(w);
        restricted_(i, j) += c;
        w -= c * basis_[i];
      }
    restricted_(j + 1, j) = w.norm();
    const bool open = restricted_(j + 1, j) > kClosed;
    if (open) w /= restricted_(j + 1, j);
    basis_.push_back(std::move(w));
    return open;
  }

  /// The largest growth factor in the space, and the residual of its motion.
  GrowthEstimate largest() const {
    const int m = size();
    const Eigensystem motions = restricted_motions();
    GrowthEstimate out;
    Eigen::Index i = 0;
    out.factor = motions.values.cwiseAbs().maxCoeff(&i);
    out.frequency = std::abs(std::arg(motions.values[i])) / (2 * kPi);
    out.residual = std::abs(restricted_(m, m - 1) * motions.vectors.col(i).normalized()[m - 1]);
    return out;
  }

  /// Keeps the motions with the `count` largest factors, or one more to keep a pair together.
  void cut(int count) {
    const int m = size();
    const Eigensystem motions = restricted_motions();
    const Eigen::VectorXd factors = motions.values.cwiseAbs();
    std::vector<int> order(m);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&factors](int a, int b) { return factors[a] > factors[b]; });
    std::vector<Eigen::VectorXd> columns;
    for (int i : order) {
      if (static_cast<int>(columns.size()) >= count) break;
      const double imaginary = motions.values[i].imag();
      if (imaginary < 0) continue;  // the conjugate stands for the pair
      columns.emplace_back(motions.vectors.col(i).real());
      if (imaginary > 0) columns.emplace_back(motions.vectors.col(i).imag());
    }
    const auto kept = static_cast<Eigen::Index>(columns.size());
    Eigen::MatrixXd invariant(m, kept);
    for (Eigen::Index i = 0; i < kept; ++i) invariant.col(i) = columns[i];
    change_basis(orthonormal_basis(invariant));
  }

 private:
  Eigensystem restricted_motions() const {
    return eigensystem(restricted_.topLeftCorner(size(), size()));
  }

  /// `y`: orthonormal basis (size() x kept) of an invariant space of the restricted recursion.
  void change_basis(const Eigen::MatrixXd& y) {
    const int m = size();
    const Eigen::Index kept = y.cols();
    const Eigen::MatrixXd block = y.transpose() * restricted_.topLeftCorner(m, m) * y;
    const Eigen::RowVectorXd spike = restricted_(m, m - 1) * y.row(m - 1);
    restricted_.setZero();
    restricted_.topLeftCorner(kept, kept) = block;
    restricted_.row(kept).head(kept) = spike;
    std::vector<Eigen::VectorXd> basis(kept, Eigen::VectorXd::Zero(basis_[0].size()));
    for (Eigen::Index i = 0; i < kept; ++i)
      for (int k = 0; k < m; ++k) basis[i] += y(k, i) * basis_[k];
    basis.push_back(std::move(basis_[m]));
    basis_ = std::move(basis);
  }

  const FreeRecursion& recursion_;
  std::vector<Eigen::VectorXd> basis_;
  Eigen::MatrixXd restricted_;
};

/// A random state after some steps, which fill the history with a consistent motion and damp what
/// is heavily damped.
Eigen::VectorXd smoothed_start(const FreeRecursion& recursion, int steps) {
  Eigen::VectorXd start(recursion.size());
  std::mt19937 random(1);  // the same numbers on every machine
  for (Eigen::Index i = 0; i < start.size(); ++i) start[i] = random() / 4294967296.0 - 0.5;
  recursion.remove_rigid_motion(start);
  for (int i = 0; i < steps; ++i) {
    start = recursion.apply(start);
    start.normalize();
  }
  return start;
}

}  // namespace

double holding_damping(double growth, double frequency) {
  const double angular = 2 * kPi * frequency;
  return 2 * std::log(growth) / (angular * angular);
}

GrowthEstimate growth_factor(const BodyModel& model) {
  // slow motions of thin bodies take long to tell apart where nothing else grows
  const int most_steps = model.stiffness ? 2500 : 600;
  constexpr int kMostKept = 100, kKept = 40, kCheckEvery = 20;
  constexpr double kTolerance = 1e-5;
  const FreeRecursion recursion(model);
  const int smoothing = model.discretisation.history_length + 10;
  KrylovSpace space(recursion, smoothed_start(recursion, smoothing), kMostKept);
  GrowthEstimate estimate;
  for (int step = 1; step <= most_steps; ++step) {
    const bool open = space.extend();
    const bool full = space.size() == kMostKept;  // pairs make the space after a cut odd
    if (open && !full && step % kCheckEvery != 0) continue;
    estimate = space.largest();
    estimate.steps = smoothing + step;
    // what decays anyway need not be known as well
    const double tolerance = kTolerance + 0.02 * std::max(0.0, 1 - estimate.factor);
    if (!open || estimate.residual <= tolerance) return estimate;
    if (full) space.cut(kKept);
  }
  return estimate;
}

}  // namespace bem
