#pragma once

#include "model/body_model.hpp"

namespace bem {

/// The linear functional that measures the rigid part of a displacement field (M52): rows 1-3 the
/// first-order displacement of the volume centroid [m], rows 4-6 the rotation by shape matching
/// [rad]. 6 x 3N.
Eigen::MatrixXd rigid_part(const TriangleMesh& centred_mesh);

/// Unit translations, and rotations about the origin, of some points: 3n x 6.
Eigen::MatrixXd rigid_motions(const std::vector<Vec3>& points);

/// Orthonormal columns (3N x 6) that span the rigid displacements of the nodes.
Eigen::MatrixXd orthonormal_rigid_modes(const TriangleMesh& centred_mesh);

/// Removes rigid motion from displacements by choosing the accelerations of the frame (M53), (M54):
/// u = v - B z with z = (Pi B)^{-1} Pi v and B = H_0^{-1} [D_0 Q_0], for each initial component.
class RigidProjection {
 public:
  RigidProjection() = default;
  /// `body_response`: H_0^{-1} [D_0 Q_0] by initial component, 3N x 6.
  RigidProjection(Eigen::MatrixXd rigid, std::vector<Eigen::MatrixXcd> body_response);

  /// Projects the columns of `v` (3N x n) in place and returns z (6 x n).
  Eigen::MatrixXcd project(int component, Eigen::Ref<Eigen::MatrixXcd> v) const;

  /// z (6 x n) alone, of displacements or of what Pi makes of them (6 x n).
  Eigen::MatrixXcd accelerations(int component, const Eigen::MatrixXcd& v) const;
  Eigen::MatrixXcd accelerations_of_rigid(int component, const Eigen::MatrixXcd& moved) const;
  /// B = H_0^{-1} [D_0 Q_0], 3N x 6.
  const Eigen::MatrixXcd& response(int component) const { return response_[component]; }
  const Eigen::MatrixXd& rigid() const { return rigid_; }

 private:
  Eigen::MatrixXd rigid_;
  std::vector<Eigen::MatrixXcd> response_;
  std::vector<Eigen::Matrix<Complex, 6, 6>> inverse_;  ///< of Pi B
};

}  // namespace bem
