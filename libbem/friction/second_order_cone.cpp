#include "friction/second_order_cone.hpp"

#include <algorithm>
#include <cmath>

namespace bem::cone {

double determinant(const Vec3& x) {
  const double t = std::hypot(x[1], x[2]);
  return (x[0] - t) * (x[0] + t);
}

Vec3 product(const Vec3& x, const Vec3& y) {
  return {x.dot(y), x[0] * y[1] + y[0] * x[1], x[0] * y[2] + y[0] * x[2]};
}

Vec3 quotient(const Vec3& b, const Vec3& x) {
  Vec3 y;
  y[0] = (x[0] * b[0] - x[1] * b[1] - x[2] * b[2]) / determinant(x);
  y.tail<2>() = (b.tail<2>() - y[0] * x.tail<2>()) / x[0];
  return y;
}

double step_to_boundary(const Vec3& x, const Vec3& d) {
  constexpr double kFar = 1e10;
  double t = d[0] < 0 ? std::min(kFar, -x[0] / d[0]) : kFar;
  // a t^2 + 2 b t + c, positive at t = 0
  const double a = d[0] * d[0] - d.tail<2>().squaredNorm();
  const double b = x[0] * d[0] - x.tail<2>().dot(d.tail<2>());
  const double c = determinant(x);
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return t;
  const double sum = -(b + (b >= 0 ? 1 : -1) * std::sqrt(discriminant));
  for (double root : {sum / a, c / sum})
    if (root > 0) t = std::min(t, root);
  return t;
}

Scaling nesterov_todd(const Vec3& y, const Vec3& z) {
  const Mat3 reflection = Vec3(1, -1, -1).asDiagonal();
  const double y_length = std::sqrt(determinant(y)), z_length = std::sqrt(determinant(z));
  const Vec3 y_unit = y / y_length, z_unit = z / z_length;
  const double cosine = std::sqrt((1 + z_unit.dot(y_unit)) / 2);
  Vec3 v = (y_unit + reflection * z_unit) / (2 * cosine);
  v[0] += 1;
  v /= std::sqrt(2 * v[0]);
  const double size = std::sqrt(y_length / z_length);
  const Vec3 w = reflection * v;
  Scaling scaling;
  scaling.matrix = size * (2 * v * v.transpose() - reflection);
  scaling.inverse = (2 * w * w.transpose() - reflection) / size;
  scaling.point = scaling.matrix * z;
  return scaling;
}

}  // namespace bem::cone
