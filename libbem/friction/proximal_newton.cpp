#include "friction/proximal_newton.hpp"

#include "base/interruption.hpp"
#include "friction/natural_map.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

namespace bem {
namespace {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

constexpr std::size_t kMemory = 4;  ///< residuals that a step may rise to (nonmonotone search)
/// Lengths of a step that are tried: whole and half. Where many contacts open or close at once the
/// residual rises for a step or two before it falls, and shorter steps would follow its kinks.
constexpr int kLengths = 2;
constexpr double kDecrease = 1e-3;    ///< decrease of the residual asked for, relative to the step
constexpr double kInexactness = 0.1;  ///< residual over proximal term at which a problem is solved
constexpr double kRise = 10;          ///< of alpha after a failure
constexpr int kCautious = 5;          ///< problems after a failure for which alpha falls slowly
constexpr double kLeastAlpha = 1e-12, kLargestAlpha = 1e3;

/// Residual of Alart and Curnier for one contact with tau = r - u / scale, in units of force:
/// open (tau_n <= 0): r; else u_n / scale and r_t - P(tau_t), P on the disc of radius mu tau_n.
Vec3 contact_residual(const Vec3& r, const Vec3& u, double mu, double scale) {
  const Vec3 tau = r - u / scale;
  if (tau[0] <= 0) return r;
  const double length = std::hypot(tau[1], tau[2]);
  if (length <= mu * tau[0]) return u / scale;
  const double shrink = mu * tau[0] / length;
  return {u[0] / scale, r[1] - shrink * tau[1], r[2] - shrink * tau[2]};
}

/// Its derivatives times the scale where the contact is closed; false where it is open.
bool contact_derivatives(const Vec3& r, const Vec3& u, double mu, double scale, Mat3& by_u,
                         Mat3& by_r) {
  const Vec3 tau = r - u / scale;
  if (tau[0] <= 0) return false;
  by_u.setIdentity();
  by_r.setZero();
  const double length = std::hypot(tau[1], tau[2]);
  if (length <= mu * tau[0]) return true;
  const Vec2 along = tau.tail<2>() / length;
  const Mat2 across = mu * tau[0] / length * (Mat2::Identity() - along * along.transpose());
  by_u.block<2, 1>(1, 0) = mu * along;
  by_u.block<2, 2>(1, 1) = across;
  by_r.block<2, 1>(1, 0) = -scale * mu * along;
  by_r.block<2, 2>(1, 1) = scale * (Mat2::Identity() - across);
  return true;
}

/// Faster decrease of alpha after easy problems; slow for a while after a failure.
double reduction(int steps, int recent_failures) {
  if (recent_failures > 0) return 0.5;
  return steps <= 4 ? 0.03 : steps <= 10 ? 0.1 : 0.3;
}

}  // namespace

ProximalNewton::ProximalNewton(const ContactSet& set)
    : set_(set),
      system_(set.problem),
      left_(set.problem.contacts()),
      own_(set.problem.contacts()) {}

/// u with the proximal term, of all contacts.
void ProximalNewton::displacements(const Eigen::VectorXd& forces, Eigen::VectorXd& u) const {
  u.resize(forces.size());
  for (int i = 0; i < set_.problem.contacts(); ++i)
    u.segment<3>(3 * i) = displacement(set_.problem, i, forces) +
                          alpha_ * set_.scale[i] * (forces - centre_).segment<3>(3 * i);
}

double ProximalNewton::residual(const Eigen::VectorXd& r, const Eigen::VectorXd& u,
                                Eigen::VectorXd& value) const {
  value.resize(r.size());
  double sum = 0;
  for (int i = 0; i < set_.problem.contacts(); ++i) {
    value.segment<3>(3 * i) =
        set_.scale[i] * contact_residual(r.segment<3>(3 * i), u.segment<3>(3 * i),
                                         set_.problem.mu[i], set_.scale[i]);
    sum += value.segment<3>(3 * i).squaredNorm();
  }
  return std::sqrt(sum);
}

bool ProximalNewton::newton_direction(const Eigen::VectorXd& r, const Eigen::VectorXd& u,
                                      const Eigen::VectorXd& value) {
  check_interruption();
  const FrictionProblem& p = set_.problem;
  closed_.clear();
  direction_ = Eigen::VectorXd::Zero(r.size());
  bool releases = false;
  for (int i = 0; i < p.contacts(); ++i) {
    if (contact_derivatives(r.segment<3>(3 * i), u.segment<3>(3 * i), p.mu[i], set_.scale[i],
                            left_[i], own_[i])) {
      own_[i] += alpha_ * set_.scale[i] * left_[i];
      closed_.push_back(i);
    } else {
      direction_.segment<3>(3 * i) = -r.segment<3>(3 * i);
      releases = releases || !r.segment<3>(3 * i).isZero(0);
    }
  }
  right_side_.resize(static_cast<Eigen::Index>(3 * closed_.size()));
  for (std::size_t a = 0; a < closed_.size(); ++a) {
    const int i = closed_[a];
    Vec3 b = -value.segment<3>(3 * i);
    if (releases) b -= left_[i] * (displacement(p, i, direction_) - p.q.segment<3>(3 * i));
    right_side_.segment<3>(static_cast<Eigen::Index>(3 * a)) = b;
  }
  ++steps_;
  if (!system_.factorise(closed_, left_, own_)) return false;
  system_.solve(right_side_);
  for (std::size_t a = 0; a < closed_.size(); ++a)
    direction_.segment<3>(3 * closed_[a]) =
        right_side_.segment<3>(static_cast<Eigen::Index>(3 * a));
  return direction_.allFinite();
}

/// Takes the longest step whose residual is below the reference, else the best one tried. Returns
/// the step.
double ProximalNewton::line_search(double reference, Eigen::VectorXd& r, Eigen::VectorXd& u) {
  const FrictionProblem& p = set_.problem;
  change_.resize(r.size());
  for (int i = 0; i < p.contacts(); ++i)
    change_.segment<3>(3 * i) = displacement(p, i, direction_) - p.q.segment<3>(3 * i) +
                                alpha_ * set_.scale[i] * direction_.segment<3>(3 * i);
  double best_norm = std::numeric_limits<double>::infinity(), best_step = 0, step = 1;
  for (int length = 0; length < kLengths; ++length, step *= 0.5) {
    trial_r_ = r + step * direction_;
    trial_u_ = u + step * change_;
    const double norm = residual(trial_r_, trial_u_, trial_value_);
    if (norm < best_norm) {
      best_norm = norm;
      best_step = step;
    }
    if (norm <= (1 - kDecrease * step) * reference) break;
  }
  r += best_step * direction_;
  u += best_step * change_;
  return best_step;
}

/// Newton's method for one regularised problem from r; true if it is solved.
bool ProximalNewton::solve_regularised(double goal, int max_steps, Eigen::VectorXd& r) {
  Eigen::VectorXd u, value;
  displacements(r, u);
  std::deque<double> recent;
  for (int step = 0;; ++step) {
    const double norm = residual(r, u, value);
    double proximal = 0;
    for (int i = 0; i < set_.problem.contacts(); ++i)
      proximal += (set_.scale[i] * (r - centre_).segment<3>(3 * i)).squaredNorm();
    if (norm <= std::max(kInexactness * alpha_ * std::sqrt(proximal), goal)) return true;
    if (step == max_steps) return false;
    recent.push_back(norm);
    if (recent.size() > kMemory) recent.pop_front();
    if (!newton_direction(r, u, value)) return false;
    if (line_search(*std::max_element(recent.begin(), recent.end()), r, u) == 0) return false;
  }
}

bool ProximalNewton::solve_compliant(double alpha, int max_steps, Eigen::VectorXd& forces,
                                     int& steps) {
  constexpr double kGoal = 1e-3;  // of the displacement that the softness allows
  steps_ = 0;
  alpha_ = alpha;
  centre_ = Eigen::VectorXd::Zero(forces.size());
  const bool solved = solve_regularised(kGoal * alpha, max_steps, forces);
  steps += steps_;
  return solved;
}

int ProximalNewton::solve(double tolerance, double regularisation, const NewtonLimits& limits,
                          BestForces& best) {
  steps_ = 0;
  alpha_ = regularisation;
  centre_ = best.forces();
  double centre_error = best.error();
  double goal = 0.3 * tolerance;
  int failures = 0, recent_failures = 0;
  while (best.error() > tolerance && goal > 1e-3 * tolerance && steps_ < limits.steps &&
         failures <= limits.failures) {
    Eigen::VectorXd r = centre_;
    const int before = steps_;
    const bool solved =
        solve_regularised(goal, std::min(limits.steps_per_goal, limits.steps - steps_), r);
    const double error = best.consider(r);
    if (steps_ == before) goal *= 0.1;  // the residual and the error differ: nothing was to do
    if (solved) {
      alpha_ = std::max(kLeastAlpha, alpha_ * reduction(steps_ - before, recent_failures));
      recent_failures = std::max(0, recent_failures - 1);
    } else {
      ++failures;
      recent_failures = kCautious;
      alpha_ = std::min(kLargestAlpha, kRise * alpha_);
    }
    if (solved || error < 0.5 * centre_error) {
      centre_ = r;
      centre_error = error;
    }
  }
  return steps_;
}

}  // namespace bem
