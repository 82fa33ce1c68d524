#pragma once

#include "model/body_model.hpp"

namespace bem {

/// The accelerations z = -(a', alpha) of the frame in the inertial form, by the balance of forces
/// and torques of a step: with the rigid motions R, H_0 R = -sigma F_0, F_0 = [D_0 Q_0] and
/// sigma = (lambda/dt)^2 of an initial component
///
///     H_0 u = b - F_0 z   gives   (R^T F_0) z = R^T b + sigma F_0^T u.
///
/// D(0) has no part in it, and the body forces F_0 are stored as they are: what a codec has made of
/// the other matrices changes z by the inertia of the error in u alone, which is nothing at rest.
class FrameBalance {
 public:
  /// Of a model in the inertial form.
  explicit FrameBalance(const BodyModel& model);

  /// R, 3N x 6.
  const Eigen::MatrixXd& rigid_motions() const { return rigid_; }
  /// R^T b, forces [N] and torques [N m] of the columns of b (3N x n).
  Eigen::MatrixXd moments(const Eigen::MatrixXd& b) const;
  Eigen::MatrixXcd moments(const Eigen::MatrixXcd& b) const;
  /// F_0 of an initial component, 3N x 6.
  const Eigen::MatrixXcd& body_force(int component) const {
    return model_.initial_body_force[component];
  }
  /// H_0^{-1} F_0 = -R/sigma, 3N x 6.
  Eigen::MatrixXcd response(int component) const;
  /// What forces b (3N x n) move the body rigidly: the part of H_0^{-1} b that a stored inverse
  /// lacks.
  Eigen::MatrixXcd moved(int component, const Eigen::MatrixXcd& b) const;
  /// z (6 x n) from F_0^T u and R^T b.
  Eigen::MatrixXcd accelerations(int component, const Eigen::MatrixXcd& inertia,
                                 const Eigen::MatrixXcd& moments) const;

 private:
  const BodyModel& model_;
  Eigen::MatrixXd rigid_;
  std::vector<Complex> sigma_;                         ///< [1/s^2]
  std::vector<Eigen::Matrix<Complex, 6, 6>> inverse_;  ///< of R^T F_0
};

}  // namespace bem
