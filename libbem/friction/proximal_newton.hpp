#pragma once

#include "friction/block_system.hpp"
#include "friction/set_solver.hpp"

namespace bem {

/// Limits of one call of ProximalNewton::solve.
struct NewtonLimits {
  int steps = 200;          ///< linear solves
  int steps_per_goal = 25;  ///< linear solves of one regularised problem
  int failures = 1000;      ///< regularised problems that may fail
};

/// Semismooth Newton method on the function of Alart and Curnier [1991], with proximal
/// regularisation: the problems solved have u + alpha w_i (r - r_k) in place of u, r_k the last
/// solution, so W may be rank-deficient (hyperstatic). alpha falls as long as the problems are
/// solved and rises where one is not [Rockafellar 1976]. Contacts that open are eliminated, so a
/// linear solve costs what the closed ones need.
class ProximalNewton {
 public:
  explicit ProximalNewton(const ContactSet& set);

  /// Improves `best` until its error is at most `tolerance`; returns the number of linear solves.
  int solve(double tolerance, double regularisation, const NewtonLimits& limits, BestForces& best);

  /// Solves the problem with contacts that give way, by `alpha` times what their own blocks do:
  /// u + alpha w_i r in place of u. Starts from `forces`, which receives the solution; false after
  /// `max_steps` linear solves without one. `steps` counts them.
  bool solve_compliant(double alpha, int max_steps, Eigen::VectorXd& forces, int& steps);

 private:
  void displacements(const Eigen::VectorXd& forces, Eigen::VectorXd& u) const;
  double residual(const Eigen::VectorXd& r, const Eigen::VectorXd& u, Eigen::VectorXd& value) const;
  bool newton_direction(const Eigen::VectorXd& r, const Eigen::VectorXd& u,
                        const Eigen::VectorXd& value);
  double line_search(double reference, Eigen::VectorXd& r, Eigen::VectorXd& u);
  bool solve_regularised(double goal, int max_steps, Eigen::VectorXd& r);

  const ContactSet& set_;
  BlockSystem system_;
  double alpha_ = 0;
  int steps_ = 0;           ///< linear solves of the running call
  Eigen::VectorXd centre_;  ///< r_k
  Eigen::VectorXd direction_, change_, trial_r_, trial_u_, trial_value_, right_side_;
  std::vector<int> closed_;
  std::vector<Mat3> left_, own_;  ///< derivatives of the residual by u and by r
};

}  // namespace bem
