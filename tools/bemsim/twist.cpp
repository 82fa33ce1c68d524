#include "twist.hpp"

#include "dynamics/rotation.hpp"
#include "mesh/describe.hpp"
#include "scene/location.hpp"
#include "scene/motion.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

constexpr double kLimit = kPi;

/// A set of vertices that move together, until they are released.
struct Group {
  Motion motion;
  double end;  ///< [s]
};

std::vector<Group> groups_of(const BodySpec& body, double duration) {
  std::vector<Group> groups;
  if (!body.fixed.empty()) groups.push_back({{}, duration});
  for (const HandleSpec& h : body.handles)
    groups.push_back({h.motion, std::min(duration, h.release_time.value_or(duration))});
  return groups;
}

/// How far a group may turn between two times without a keyframe in between [rad], at most.
double turn_between(const Group& group, double begin, double end) {
  for (std::size_t k = 1; k < group.motion.size(); ++k)
    if (group.motion[k].time > begin && group.motion[k - 1].time < end)
      return turn_rate(group.motion[k - 1], group.motion[k]) * (end - begin);
  return 0;
}

/// Calls f(t) at times of the motion of both groups that are near enough that neither can turn by
/// half a turn between two of them, until f returns false or it has been called very often.
template <class F>
void sample(const Group& a, const Group& b, const F& f) {
  constexpr double kStep = kPi / 8;
  constexpr long kMostSamples = 200000;
  const double end = std::min(a.end, b.end);
  std::vector<double> keys{0, end};
  for (const Group* g : {&a, &b})
    for (const Keyframe& k : g->motion)
      if (k.time > 0 && k.time < end) keys.push_back(k.time);
  std::sort(keys.begin(), keys.end());
  long samples = 0;
  for (std::size_t i = 1; i < keys.size(); ++i) {
    const double begin = keys[i - 1], length = keys[i] - begin;
    // between rotations about different axes the way is the shortest: less than half a turn
    const double turns = kPi + turn_between(a, begin, keys[i]) + turn_between(b, begin, keys[i]);
    const double parts = std::ceil(2 * turns / kStep);
    for (double k = 1; k <= parts; ++k)
      if (++samples > kMostSamples || !f(begin + length * (k / parts))) return;
  }
}

/// The rotation vector of r that is nearest to `last`: full turns are counted.
Vec3 continued(const Mat3& r, const Vec3& last) {
  const Vec3 w = rotation_log(r);
  const double angle = w.norm();
  const Vec3 axis = angle > 1e-9         ? Vec3(w / angle)
                    : last.norm() > 1e-9 ? Vec3(last.normalized())
                                         : Vec3(Vec3::UnitX());
  return w + 2 * kPi * std::round(axis.dot(last - w) / (2 * kPi)) * axis;
}

Twist twist_of(const Group& a, const Group& b) {
  constexpr double kFar = 3 * kLimit;  // what comes after it does not matter
  Twist twist;
  Vec3 turn = Vec3::Zero();
  sample(a, b, [&](double t) {
    turn = continued(motion_at(a.motion, t).rotation.transpose() * motion_at(b.motion, t).rotation,
                     turn);
    if (turn.norm() > kLimit * (1 + 1e-9) && twist.angle <= kLimit * (1 + 1e-9)) twist.since = t;
    twist.angle = std::max(twist.angle, turn.norm());
    return twist.angle < kFar;
  });
  return twist;
}

}  // namespace

std::vector<Twist> find_twists(const Scene& scene, double duration) {
  std::vector<Twist> out;
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    const std::vector<Group> groups = groups_of(scene.bodies[body], duration);
    Twist largest;
    for (std::size_t i = 0; i < groups.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Twist twist = twist_of(groups[i], groups[j]);
        if (twist.angle > largest.angle) largest = twist;
      }
    largest.body = body;
    if (largest.angle > kLimit * (1 + 1e-9)) out.push_back(largest);
  }
  return out;
}

std::string twist_text(const Scene& scene, const Twist& twist) {
  const BodySpec& body = scene.bodies[twist.body];
  return where(body.location) + ": prescribed vertices of the body " + in_quotes(body.name) +
         " turn against each other by " + rounded_text(twist.angle * 180 / kPi, 3) +
         " degrees; from about 180 degrees on, at t = " + rounded_text(twist.since, 3) +
         " s, one body cannot follow them: cut it into parts that are joined by welds";
}

std::string short_twist_text(const Scene& scene, const Twist& twist) {
  return "the body " + in_quotes(scene.bodies[twist.body].name) +
         " is twisted by more than about 180 degrees: cut it into parts that are joined by welds";
}

}  // namespace bem
