#include "constraints/joints.hpp"

#include "algebra/decompositions.hpp"
#include "dynamics/rotation.hpp"
#include "scene/motion.hpp"

namespace bem {
namespace {

/// Whether points are not on one line.
bool spread_out(const std::vector<const Joint*>& joints) {
  Vec3 centre = Vec3::Zero();
  for (const Joint* j : joints) centre += j->place / static_cast<double>(joints.size());
  Mat3 spread = Mat3::Zero();
  for (const Joint* j : joints) spread += (j->place - centre) * (j->place - centre).transpose();
  const Vec3 squares = symmetric_eigensystem(spread).values;
  return squares[1] > JointTolerances::thin * JointTolerances::thin * squares[2];
}

/// x -> rotation x + translation that brings the starts of the joints to their targets at time t,
/// as well as possible.
std::pair<Mat3, Vec3> best_motion(const std::vector<const Joint*>& joints, double t) {
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  std::vector<Vec3> targets;
  for (const Joint* j : joints) {
    targets.push_back(j->target(t));
    from += j->place / static_cast<double>(joints.size());
    to += targets.back() / static_cast<double>(joints.size());
  }
  Mat3 covariance = Mat3::Zero();
  for (std::size_t i = 0; i < joints.size(); ++i)
    covariance += (targets[i] - to) * (joints[i]->place - from).transpose();
  const Mat3 rotation = best_rotation(covariance);
  return {rotation, to - rotation * from};
}

}  // namespace

Vec3 Attachment::place(const std::vector<Vec3>& of_nodes) const {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < count; ++i) sum += weights[i] * of_nodes[nodes[i]];
  return sum;
}

bool Joint::is_active(double t) const {
  // a step that ends at the release time is still held
  return !handle || !handle->release_time ||
         t <= *handle->release_time * (1 + JointTolerances::release);
}

Vec3 Joint::target(double t) const {
  return handle ? motion_at(handle->motion, t).apply(place) : place;
}

std::optional<Holder> holder_motion(const std::vector<const Joint*>& prescribed, const Vec3& centre,
                                    double t, double dt, const StageVector& stage_times) {
  if (prescribed.size() < 3 || !spread_out(prescribed)) return std::nullopt;
  const double h = 0.01 * dt;  // for rates of change
  Holder out;
  for (Eigen::Index a = 0; a < stage_times.size(); ++a) {
    const double time = t + stage_times[a] * dt;
    const auto [now, shift] = best_motion(prescribed, time);
    const auto [before, shift_before] = best_motion(prescribed, time - h);
    const auto [after, shift_after] = best_motion(prescribed, time + h);
    out.rotation.push_back(now);
    out.centre.push_back(now * centre + shift);
    out.velocity.push_back(((after - before) * centre + shift_after - shift_before) / (2 * h));
    out.angular_velocity.push_back(rotation_log(after * before.transpose()) / (2 * h));
  }
  return out;
}

}  // namespace bem
