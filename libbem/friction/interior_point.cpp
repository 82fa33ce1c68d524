#include "friction/interior_point.hpp"

#include "base/interruption.hpp"
#include "friction/natural_map.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bem {
namespace {

constexpr double kFrictionless = 1e-9;  ///< coefficient below which friction is left out
constexpr double kToBoundary = 0.99;    ///< share of the step to the boundary
constexpr double kShortStep = 0.1;      ///< steps below are replaced by steps to the central path
constexpr double kStuck = 1e-4;         ///< steps below end the method
constexpr double kRegularisation =
    1e-3;                         ///< of W at the start, relative to the scale of the blocks
constexpr double kBalance = 0.1;  ///< y . z falls no faster than the residual times this

}  // namespace

InteriorPoint::InteriorPoint(const ContactSet& set, const Eigen::VectorXd& start)
    : set_(set), system_(set.problem), all_(set.problem.contacts()) {
  const FrictionProblem& p = set.problem;
  const int n = p.contacts();
  std::iota(all_.begin(), all_.end(), 0);
  z_ = y_ = dz_ = dy_ = residual_ = right_side_ = Eigen::VectorXd::Zero(3 * n);
  left_.resize(n);
  own_.resize(n);
  scaling_.resize(n);
  equation_.resize(n);
  scaled_.resize(n);
  for (double mu : p.mu)
    force_scale_.push_back(mu < kFrictionless ? Vec3(1, 0, 0) : Vec3(1 / mu, 1, 1));
  // every contact is moved inside by the mean normal force and the mean displacement
  double mean_force = 0, mean_displacement = 0;
  for (int i = 0; i < n; ++i) {
    mean_force += start[3 * i] / n;
    mean_displacement += part(p.q, i).norm() / n;
  }
  mean_force = std::max(mean_force, mean_displacement);
  for (int i = 0; i < n; ++i) {
    z_[3 * i] = (start[3 * i] + mean_force) / force_scale_[i][0];
    if (!frictionless(i)) z_.segment<2>(3 * i + 1) = start.segment<2>(3 * i + 1);
  }
  const Eigen::VectorXd r = forces();
  for (int i = 0; i < n; ++i) {
    const Vec3 u = displacement(p, i, r);
    if (!frictionless(i)) y_.segment<2>(3 * i + 1) = u.tail<2>();
    y_[3 * i] = (std::max(u[0], 0.0) + mean_displacement) * force_scale_[i][0] +
                y_.segment<2>(3 * i + 1).norm();
  }
}

Eigen::VectorXd InteriorPoint::forces() const {
  Eigen::VectorXd r(z_.size());
  for (int i = 0; i < set_.problem.contacts(); ++i)
    r.segment<3>(3 * i) = force_scale_[i].cwiseProduct(part(z_, i));
  return r;
}

/// Mean of y . z after a step.
double InteriorPoint::mean_product(double step) const {
  return (z_ + step * dz_).dot(y_ + step * dy_) / set_.problem.contacts();
}

/// u - y, with |u_t| linearised at y_t, in the variables of the cones.
void InteriorPoint::update_residual() {
  const Eigen::VectorXd r = forces();
  for (int i = 0; i < set_.problem.contacts(); ++i) {
    Vec3 u = force_scale_[i].cwiseProduct(displacement(set_.problem, i, r));
    left_[i] = force_scale_[i].asDiagonal();
    if (!frictionless(i)) {
      const Eigen::Vector2d slip = y_.segment<2>(3 * i + 1);
      const double length = slip.norm();
      if (length > 0) {
        const Eigen::Vector2d along = slip / length;
        u[0] += along.dot(u.tail<2>());
        left_[i].block<1, 2>(0, 1) = along.transpose();
      }
    }
    residual_.segment<3>(3 * i) = u - part(y_, i);
  }
}

/// Factorises left W force_scale + S^2 + regularisation, as a matrix that acts on changes of r.
bool InteriorPoint::factorise() {
  const double progress = std::min(1.0, mean_product(0) / first_product_);
  const double alpha = kRegularisation * std::sqrt(progress);
  for (int i = 0; i < set_.problem.contacts(); ++i) {
    scaling_[i] = cone::nesterov_todd(part(y_, i), part(z_, i));
    const Vec3 inverse = frictionless(i) ? Vec3(1, 1, 1) : Vec3(force_scale_[i].cwiseInverse());
    own_[i] = scaling_[i].matrix * scaling_[i].matrix * inverse.asDiagonal();
    own_[i].diagonal() += alpha * set_.scale[i] * force_scale_[i];
  }
  return system_.factorise(all_, left_, own_);
}

/// Right sides of y o z = target e linearised in scaled variables, with Mehrotra's second-order
/// term of the last direction if `corrected`.
void InteriorPoint::centring(double target, bool corrected, std::vector<Vec3>& right_side) const {
  for (int i = 0; i < set_.problem.contacts(); ++i) {
    const cone::Scaling& s = scaling_[i];
    right_side[i] = -cone::product(s.point, s.point);
    if (corrected)
      right_side[i] -= cone::product(s.inverse * part(dy_, i), s.matrix * part(dz_, i));
    right_side[i][0] += target;
  }
}

void InteriorPoint::find_direction(const std::vector<Vec3>& right_side) {
  for (int i = 0; i < set_.problem.contacts(); ++i) {
    scaled_[i] = scaling_[i].matrix * cone::quotient(right_side[i], scaling_[i].point);
    right_side_.segment<3>(3 * i) = scaled_[i] - part(residual_, i);
    if (frictionless(i)) right_side_.segment<2>(3 * i + 1).setZero();
  }
  system_.solve(right_side_);
  for (int i = 0; i < set_.problem.contacts(); ++i) {
    Vec3 z = part(right_side_, i);
    if (frictionless(i))
      z.tail<2>().setZero();
    else
      z = z.cwiseQuotient(force_scale_[i]);
    dz_.segment<3>(3 * i) = z;
    dy_.segment<3>(3 * i) = scaled_[i] - scaling_[i].matrix * (scaling_[i].matrix * z);
  }
}

double InteriorPoint::step_length() const {
  if (!dz_.allFinite() || !dy_.allFinite()) return 0;
  double step = 1 / kToBoundary;
  for (int i = 0; i < set_.problem.contacts(); ++i)
    step = std::min({step, cone::step_to_boundary(part(z_, i), part(dz_, i)),
                     cone::step_to_boundary(part(y_, i), part(dy_, i))});
  return kToBoundary * step;
}

bool InteriorPoint::step() {
  check_interruption();
  update_residual();
  const double product = mean_product(0), size = residual_.norm();
  if (!started_) {
    first_product_ = product;
    first_residual_ = size;
    started_ = true;
  }
  if (!(product > 0) || !factorise()) return false;

  centring(0, false, equation_);
  find_direction(equation_);
  const double predicted = mean_product(std::min(1.0, step_length() / kToBoundary)) / product;
  const double balance =
      kBalance * size / std::max(first_residual_, 1e-300) * first_product_ / product;
  const double share = std::clamp(std::max(predicted * predicted * predicted, balance), 1e-8, 1.0);
  centring(share * product, true, equation_);
  find_direction(equation_);
  double step = step_length();
  for (double target : {0.5, 0.9, 1.0}) {
    if (step >= kShortStep) break;
    const Eigen::VectorXd old_dz = dz_, old_dy = dy_;
    centring(target * product, false, equation_);
    find_direction(equation_);
    const double other = step_length();
    if (other > step) {
      step = other;
    } else {
      dz_ = old_dz;
      dy_ = old_dy;
    }
  }
  z_ += step * dz_;
  y_ += step * dy_;
  return step > kStuck;
}

}  // namespace bem
