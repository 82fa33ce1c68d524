#pragma once

#include "friction/block_system.hpp"
#include "friction/second_order_cone.hpp"
#include "friction/set_solver.hpp"

namespace bem {

/// Primal-dual interior point method for frictional contact [Acary, Armand, Nguyen and
/// Shpakovych]: in the variables z = (mu r_n, r_t) and y = (u_n / mu + |u_t|, u_t) the contact law
/// is
///
///     y in L, z in L, y . z = 0,        L the second-order cone,
///
/// of which the central path (y o z = target e) is followed by Newton's method with the scaling of
/// Nesterov and Todd and Mehrotra's corrections. W may be singular (hyperstatic problems).
class InteriorPoint {
 public:
  /// Starts near the forces `start`, moved inside the cones.
  InteriorPoint(const ContactSet& set, const Eigen::VectorXd& start);

  /// One step: one factorisation of 3n x 3n. False if it made no progress (a step that hardly
  /// moves, a singular system).
  bool step();

  /// The forces of the iterate.
  Eigen::VectorXd forces() const;

 private:
  void update_residual();
  double mean_product(double step) const;
  bool factorise();
  void find_direction(const std::vector<Vec3>& right_side);
  void centring(double target, bool corrected, std::vector<Vec3>& right_side) const;
  double step_length() const;
  Vec3 part(const Eigen::VectorXd& x, int i) const { return x.segment<3>(3 * i); }
  bool frictionless(int i) const { return force_scale_[i][1] == 0; }

  const ContactSet& set_;
  BlockSystem system_;
  std::vector<int> all_;
  std::vector<Vec3> force_scale_;  ///< r = force_scale z; tangential 0 without friction
  Eigen::VectorXd z_, y_, dz_, dy_, residual_, right_side_;
  std::vector<Mat3> left_, own_;
  std::vector<cone::Scaling> scaling_;
  std::vector<Vec3> equation_, scaled_;  ///< right sides of the complementarity equations
  double first_product_ = 0, first_residual_ = 0;
  bool started_ = false;
};

}  // namespace bem
