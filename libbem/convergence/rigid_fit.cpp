#include "convergence/rigid_fit.hpp"

#include "algebra/decompositions.hpp"

#include <Eigen/Geometry>

namespace bem {
namespace {

Vec3 weighted_mean(const std::vector<Vec3>& points, const std::vector<double>& weights) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) sum += weights[i] * points[i];
  return sum;
}

/// Horn's matrix of m = sum_i w_i X_i x_i^T, whose largest eigenvalue belongs to the unit
/// quaternion (w, x, y, z) of the rotation.
Eigen::Matrix4d quaternion_matrix(const Mat3& m) {
  const Vec3 skew(m(1, 2) - m(2, 1), m(2, 0) - m(0, 2), m(0, 1) - m(1, 0));
  Eigen::Matrix4d n;
  n(0, 0) = m.trace();
  n.topRightCorner<1, 3>() = skew.transpose();
  n.bottomLeftCorner<3, 1>() = skew;
  n.bottomRightCorner<3, 3>() = m + m.transpose() - m.trace() * Mat3::Identity();
  return n;
}

}  // namespace

RigidFit fit_rigid_motion(const std::vector<Vec3>& rest, const std::vector<Vec3>& positions,
                          const std::vector<double>& weights) {
  RigidFit fit;
  fit.rest_centre = weighted_mean(rest, weights);
  fit.centre = weighted_mean(positions, weights);
  Mat3 m = Mat3::Zero();
  for (std::size_t i = 0; i < rest.size(); ++i)
    m += weights[i] * (rest[i] - fit.rest_centre) * (positions[i] - fit.centre).transpose();
  const Eigen::Vector4d q = symmetric_eigensystem(quaternion_matrix(m)).vectors.col(3);
  fit.rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  return fit;
}

}  // namespace bem
