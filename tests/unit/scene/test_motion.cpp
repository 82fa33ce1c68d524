#include "scene/motion.hpp"
#include "scene/scene_json.hpp"
#include "scene_examples.hpp"

#include <limits>

#include <catch2/catch.hpp>

using bem::AxisAngle;
using bem::interpolated_rotation;
using bem::Keyframe;
using bem::kPi;
using bem::Mat3;
using bem::Motion;
using bem::motion_at;
using bem::Vec3;

namespace {

Keyframe key(double time, const Vec3& translate, const Vec3& axis, double angle,
             const Vec3& about = Vec3::Zero()) {
  return {time, translate, {axis.normalized(), angle}, about};
}

bool equal(const Mat3& a, const Mat3& b) {
  return (a - b).norm() < 1e-14;
}

const Vec3 kX = Vec3::UnitX(), kY = Vec3::UnitY(), kZ = Vec3::UnitZ(), kO = Vec3::Zero();

}  // namespace

TEST_CASE("an axis and an angle make a right-handed rotation") {
  REQUIRE((AxisAngle{kZ, kPi / 2}.matrix() * kX - kY).norm() < 1e-15);
  REQUIRE((AxisAngle{kX, -kPi / 2}.matrix() * kY + kZ).norm() < 1e-15);
  REQUIRE(equal(AxisAngle{}.matrix(), Mat3::Identity()));
}

TEST_CASE("a motion takes the values of its keyframes and is constant outside") {
  const Motion motion = {key(1, Vec3(1, 2, 3), kZ, 0.5), key(2, Vec3(4, 5, 6), kZ, 1.5),
                         key(4, kO, kX, 0.25)};
  const auto check = [&](double t, const Keyframe& k) {
    const bem::RigidMotion m = motion_at(motion, t);
    REQUIRE(m.translate == k.translate);
    REQUIRE(equal(m.rotation, k.rotate.matrix()));
  };
  check(-10, motion[0]);
  check(1, motion[0]);
  check(2, motion[1]);
  check(4, motion[2]);
  check(1e9, motion[2]);
  check(std::numeric_limits<double>::infinity(), motion[2]);
}

TEST_CASE("translation and angle are linear in time, beyond full turns too") {
  const Motion motion = {key(1, Vec3(1, 0, 0), kZ, kPi / 2), key(3, Vec3(5, 0, -4), kZ, 4.5 * kPi)};
  const bem::RigidMotion m = motion_at(motion, 1.5);
  REQUIRE((m.translate - Vec3(2, 0, -1)).norm() < 1e-15);
  REQUIRE(equal(m.rotation, AxisAngle{kZ, 1.5 * kPi}.matrix()));
}

TEST_CASE("an angle of zero has the axis of its neighbour, opposite axes are one") {
  const double s = 0.25, angle = 6;
  const AxisAngle none{kX, 0}, turned{kZ, angle};
  REQUIRE(equal(interpolated_rotation(none, turned, s), AxisAngle{kZ, s * angle}.matrix()));
  REQUIRE(equal(interpolated_rotation(turned, none, s), AxisAngle{kZ, (1 - s) * angle}.matrix()));
  REQUIRE(equal(interpolated_rotation({kZ, 1}, {-kZ, 3}, s), AxisAngle{kZ, 0}.matrix()));
  REQUIRE(equal(interpolated_rotation(none, {kY, 0}, s), Mat3::Identity()));
}

TEST_CASE("between different axes the rotation takes the shortest way at a constant rate") {
  const AxisAngle a{kZ, 0.7}, b{Vec3(1, 2, -1).normalized(), 1.9};
  REQUIRE(equal(interpolated_rotation(a, b, 0), a.matrix()));
  REQUIRE(equal(interpolated_rotation(a, b, 1), b.matrix()));
  const Mat3 first = interpolated_rotation(a, b, 0.3) * a.matrix().transpose();
  const Mat3 later =
      interpolated_rotation(a, b, 0.9) * interpolated_rotation(a, b, 0.6).transpose();
  REQUIRE(equal(first, later));
  REQUIRE((first.trace() - 1) / 2 < 0.999);
  REQUIRE(equal(first * first.transpose(), Mat3::Identity()));
}

TEST_CASE("points turn about the centre and are then displaced") {
  const Motion motion = {key(0, kO, kZ, 0, Vec3(1, 0, 0)),
                         key(1, Vec3(0, 0, 5), kZ, kPi, Vec3(1, 0, 0))};
  REQUIRE((motion_at(motion, 0).apply(Vec3(3, 1, 0)) - Vec3(3, 1, 0)).norm() < 1e-15);
  REQUIRE((motion_at(motion, 1).apply(Vec3(3, 1, 0)) - Vec3(-1, -1, 5)).norm() < 1e-14);
  REQUIRE((motion_at(motion, 0.5).apply(Vec3(3, 1, 0)) - Vec3(0, 2, 2.5)).norm() < 1e-14);
}

TEST_CASE("a motion without keyframes moves nothing") {
  REQUIRE(motion_at({}, 3).apply(Vec3(1, 2, 3)) == Vec3(1, 2, 3));
}

TEST_CASE("the centre of rotation is inherited from the keyframe before") {
  const bem::Scene scene = bem::parse_scene(
      "s.json", bem::test::scene_with_body(
                    ", \"handles\": [{\"select\": \"all\", \"motion\": [{\"time\": 0}, "
                    "{\"time\": 1, \"about\": [1,2,3]}, {\"time\": 2}]}]"));
  const Motion& motion = scene.bodies[0].handles[0].motion;
  REQUIRE(motion[0].about == Vec3(0, 0, 0));
  REQUIRE(motion[1].about == Vec3(1, 2, 3));
  REQUIRE(motion[2].about == Vec3(1, 2, 3));
}

TEST_CASE("a profile is piecewise linear, constant outside and 1 if empty") {
  const bem::Profile profile = {{0.1, 2}, {0.2, 4}, {0.6, -4}};
  REQUIRE(bem::profile_value(profile, 0) == 2);
  REQUIRE(bem::profile_value(profile, 0.1) == 2);
  REQUIRE(bem::profile_value(profile, 0.15) == Approx(3).epsilon(1e-14));
  REQUIRE(bem::profile_value(profile, 0.2) == 4);
  REQUIRE(bem::profile_value(profile, 0.3) == Approx(2).epsilon(1e-14));
  REQUIRE(bem::profile_value(profile, 0.6) == -4);
  REQUIRE(bem::profile_value(profile, 7) == -4);
  REQUIRE(bem::profile_value({{5, 3}}, 5) == 3);
  REQUIRE(bem::profile_value({}, 0.3) == 1);
}

TEST_CASE("a motion goes on to a target by the shortest turn") {
  const Motion before = {key(0, kO, kZ, 0, kX), key(1, Vec3(1, 0, 2), kZ, 3, Vec3(2, 1, 0))};
  for (const Vec3& axis : {kZ, Vec3(-kZ), Vec3(1, 2, 3)})
    for (double angle : {3.5, 3.5 + 4 * kPi, -3.5, 0.0}) {
      const Keyframe target = key(1.5, Vec3(0, 1, 0), axis, angle, kY);
      const Motion motion = bem::motion_to(before, 0.8, target);
      const Vec3 x(0.3, -0.2, 0.5);
      const double start =
          (motion_at(motion, 0.8).apply(x) - motion_at(before, 0.8).apply(x)).norm();
      REQUIRE(start < 1e-14);
      const bem::RigidMotion end = motion_at(motion, 2), wanted = motion_at({target}, 2);
      REQUIRE((end.apply(x) - wanted.apply(x)).norm() < 1e-14);
      const Mat3 half = motion_at(motion, 1.15).rotation;
      const Eigen::AngleAxisd first(Mat3(half * motion_at(motion, 0.8).rotation.transpose()));
      REQUIRE(first.angle() <= kPi / 2 + 1e-12);
    }
}
