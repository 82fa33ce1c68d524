#pragma once

#include "dynamics/frame_offset.hpp"
#include "model/elastic_system.hpp"

namespace bem {

/// The paper's correction of a step (its section 3.2.1): the rigid motion that is left in the
/// displacements is measured and removed, and the accelerations of the frame are those that
/// satisfy the equation of motion of the rest best. They differ from force over mass by the
/// discretisation error, so that momentum is not exact.
class LeastSquaresCorrection {
 public:
  /// For a multistep method. Solves six equations with H_0^T, O(N^2) each.
  explicit LeastSquaresCorrection(const ElasticSystem& system);

  /// The accelerations (a', alpha) of a step from its predicted displacements (3N), those that the
  /// frame would have without acceleration (v = H_0^{-1} (h + G_0 p)), and the accelerations that
  /// were predicted; all in body axes.
  Vector6 accelerations(const Eigen::VectorXd& predicted, const Eigen::VectorXd& v,
                        const Vector6& predicted_accelerations) const;

 private:
  const TriangleMesh& mesh_;
  std::vector<double> weights_;      ///< of the nodes when shapes are matched
  Eigen::MatrixXd residual_forces_;  ///< [D_0 Q_0]^T H_0, 6 x 3N
  Eigen::Matrix<double, 6, 6> normal_;
};

}  // namespace bem
