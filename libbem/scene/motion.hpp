#pragma once

#include "base/types.hpp"
#include "scene/scene.hpp"

namespace bem {

/// x -> about + rotation (x - about) + translate, in world coordinates.
struct RigidMotion {
  Mat3 rotation = Mat3::Identity();
  Vec3 about = Vec3::Zero();      ///< [m]
  Vec3 translate = Vec3::Zero();  ///< [m]

  Vec3 apply(const Vec3& x) const { return about + rotation * (x - about) + translate; }
};

/// Where `motion` has brought things at time `t` [s]: the values of a keyframe at its time, those
/// of the first before it and of the last after it, the identity without keyframes.
///
/// Between two keyframes `translate` and `about` are linear in time, and the body turns at a
/// constant rate. If both rotations have the same axis (or opposite ones, or one of the angles is
/// 0), the angle is linear in time and may exceed a full turn. If the axes differ, the way from the
/// first rotation R0 to the second R1 is the shortest: R(s) = exp(s log(R1 R0^T)) R0, s from 0
/// to 1.
RigidMotion motion_at(const Motion& motion, double t);

/// The motion that is at time `t` where `before` is, and comes to `target` at its later time by the
/// shortest turn.
Motion motion_to(const Motion& before, double t, const Keyframe& target);

/// How fast a motion turns from one keyframe to the next [rad/s]: at most this, as described for
/// motion_at.
double turn_rate(const Keyframe& from, const Keyframe& to);

/// The largest turn_rate() of a motion [rad/s].
double fastest_turn(const Motion& motion);

/// Where points of an obstacle's scaled mesh are at time `t` [s], in world coordinates [m].
std::vector<Vec3> placed_at(const MeshObstacle& obstacle, const std::vector<Vec3>& points,
                            double t);

/// Rotation by the fraction `s` in [0, 1] of the way from `a` to `b`, as described for motion_at.
Mat3 interpolated_rotation(const AxisAngle& a, const AxisAngle& b, double s);

/// The factor at time `t` [s]: piecewise linear between the points, the first factor before the
/// first point, the last after the last, 1 without points.
double profile_value(const Profile& profile, double t);

}  // namespace bem
