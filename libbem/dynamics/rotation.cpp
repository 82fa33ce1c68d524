#include "dynamics/rotation.hpp"

#include <cmath>

#include <Eigen/SVD>

namespace bem {

Mat3 rotation_exp(const Vec3& v) {
  const double angle = v.norm();
  const Mat3 k = cross_matrix(v);
  const double a = angle < 1e-4 ? 1 - angle * angle / 6 : std::sin(angle) / angle;
  const double half = 0.5 * angle;
  const double sinc = half < 1e-4 ? 1 - half * half / 6 : std::sin(half) / half;
  return Mat3::Identity() + a * k + 0.5 * sinc * sinc * k * k;
}

Vec3 rotation_log(const Mat3& rotation) {
  const Eigen::AngleAxisd angle_axis(rotation);
  return angle_axis.angle() * angle_axis.axis();
}

Vec3 rotation_vector_rate(const Vec3& theta, const Vec3& omega) {
  const double angle = theta.norm();
  double c = 1.0 / 12;  // (1 - (angle/2) cot(angle/2)) / angle^2
  if (angle > 1e-3) {
    const double half = 0.5 * angle;
    c = (1 - half / std::tan(half)) / (angle * angle);
  } else {
    c += angle * angle / 720;
  }
  const Vec3 turn = theta.cross(omega);
  return omega - 0.5 * turn + c * theta.cross(turn);
}

Mat3 best_rotation(const Mat3& m) {
  const Eigen::JacobiSVD<Mat3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  return svd.matrixU() * Vec3(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
}

Mat3 orthonormalised(const Mat3& rotation) {
  return Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
}

}  // namespace bem
