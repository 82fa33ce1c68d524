#include "scene/motion.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace bem {
namespace {

/// The element of `points` after which `t` lies, given that the first one is not after `t` and the
/// last one is.
template <class Point>
std::size_t interval_of(const std::vector<Point>& points, double t) {
  const auto next = std::upper_bound(points.begin(), points.end(), t,
                                     [](double time, const Point& p) { return time < p.time; });
  return static_cast<std::size_t>(next - points.begin()) - 1;
}

RigidMotion at_keyframe(const Keyframe& key) {
  return {key.rotate.matrix(), key.about, key.translate};
}

template <class Value>
Value linear(const Value& a, const Value& b, double s) {
  return (1 - s) * a + s * b;
}

}  // namespace

Mat3 AxisAngle::matrix() const {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

Mat3 interpolated_rotation(const AxisAngle& a, const AxisAngle& b, double s) {
  // One axis for both, where there is one. An angle of zero has any axis.
  constexpr double kParallel = 1e-12;
  const Vec3 axis = a.angle == 0 ? b.axis : a.axis;
  const double sign = axis.dot(b.axis) < 0 ? -1 : 1;
  if (b.angle == 0 || (axis - sign * b.axis).norm() < kParallel)
    return AxisAngle{axis, linear(a.angle, sign * b.angle, s)}.matrix();
  const Mat3 start = a.matrix();
  const Eigen::AngleAxisd way(Mat3(b.matrix() * start.transpose()));
  return Eigen::AngleAxisd(s * way.angle(), way.axis()).toRotationMatrix() * start;
}

RigidMotion motion_at(const Motion& motion, double t) {
  if (motion.empty()) return {};
  if (t <= motion.front().time) return at_keyframe(motion.front());
  if (!(t < motion.back().time)) return at_keyframe(motion.back());
  const std::size_t i = interval_of(motion, t);
  const Keyframe &a = motion[i], &b = motion[i + 1];
  const double s = (t - a.time) / (b.time - a.time);
  return {interpolated_rotation(a.rotate, b.rotate, s), linear(a.about, b.about, s),
          linear(a.translate, b.translate, s)};
}

Motion motion_to(const Motion& before, double t, const Keyframe& target) {
  const RigidMotion now = motion_at(before, t);
  const Eigen::AngleAxisd turn(now.rotation);
  const Vec3 shift = now.about - target.about;  // the same place by a rotation about the new centre
  Keyframe start{
      t, now.translate + shift - now.rotation * shift, {turn.axis(), turn.angle()}, target.about};
  Keyframe end = target;
  const double sign = turn.axis().dot(end.rotate.axis) < 0 ? -1 : 1;
  end.rotate.angle += 2 * kPi * std::round((sign * turn.angle() - end.rotate.angle) / (2 * kPi));
  return {start, end};
}

double turn_rate(const Keyframe& from, const Keyframe& to) {
  const AxisAngle &a = from.rotate, &b = to.rotate;
  const bool from_rest = a.angle == 0 || b.angle == 0;
  const bool one_axis = from_rest || a.axis.cross(b.axis).norm() < 1e-9;
  const double sign = from_rest || a.axis.dot(b.axis) > 0 ? 1 : -1;
  return (one_axis ? std::abs(b.angle - sign * a.angle) : kPi) / (to.time - from.time);
}

double fastest_turn(const Motion& motion) {
  double fastest = 0;
  for (std::size_t k = 1; k < motion.size(); ++k)
    fastest = std::max(fastest, turn_rate(motion[k - 1], motion[k]));
  return fastest;
}

std::vector<Vec3> placed_at(const MeshObstacle& obstacle, const std::vector<Vec3>& points,
                            double t) {
  const RigidMotion motion = motion_at(obstacle.motion, t);
  const Mat3 rotation = obstacle.rotation.matrix();
  std::vector<Vec3> out;
  out.reserve(points.size());
  for (const Vec3& x : points) out.push_back(motion.apply(obstacle.position + rotation * x));
  return out;
}

double profile_value(const Profile& profile, double t) {
  if (profile.empty()) return 1;
  if (t <= profile.front().time) return profile.front().factor;
  if (!(t < profile.back().time)) return profile.back().factor;
  const std::size_t i = interval_of(profile, t);
  const ProfilePoint &a = profile[i], &b = profile[i + 1];
  return linear(a.factor, b.factor, (t - a.time) / (b.time - a.time));
}

}  // namespace bem
