#include "simulation/start_joints.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "dynamics/body_output.hpp"
#include "dynamics/body_start.hpp"
#include "scene/location.hpp"

#include <map>

namespace bem {
void hold_in_place(JointPlan& plan, std::vector<Body>& bodies, std::size_t body,
                   ConstraintSolver& solver) {
  constexpr double kRounding = 1e-6;  // of the body's extent
  std::vector<Joint*> held;
  for (Joint& joint : plan.joints)
    if (joint.to_world() && joint.a.body == static_cast<int>(body)) held.push_back(&joint);
  if (held.empty()) return;
  const std::vector<Vec3> nodes = BodyOutput(bodies[body]).node_positions();
  double farthest = 0;
  for (const Joint* joint : held)
    farthest = std::max(farthest, (joint->a.place(nodes) - joint->target(0)).norm());
  if (farthest <= kRounding * bodies[body].model().geometry.extent) return;
  for (Joint* joint : held) joint->place = joint->a.place(nodes);
  BodyStart(bodies[body]).hold_here();
  solver.hold_here(body);
}

void check_joined(const JointPlan& plan, const std::vector<Body>& bodies) {
  constexpr double kMet = 1e-4;  // of the extent of a body
  std::map<int, std::vector<Vec3>> nodes;
  const auto place = [&](const Attachment& at) {
    std::vector<Vec3>& of_body = nodes[at.body];
    if (of_body.empty()) of_body = BodyOutput(bodies[at.body]).node_positions();
    return at.place(of_body);
  };
  for (const Joint& joint : plan.joints) {
    if (joint.to_world()) continue;
    const Body &a = bodies[joint.a.body], &b = bodies[joint.b.body];
    const Mat3 to_body = a.frame().rotation().transpose();
    const double gap = (to_body * (place(joint.b) - place(joint.a)) - joint.offset).norm();
    if (gap > kMet * a.model().geometry.extent)
      throw Error(ErrorCode::invalid_input,
                  "a joint connects points of " + in_quotes(a.name()) + " and " +
                      in_quotes(b.name()) + " that are " + rounded_text(gap, 3) +
                      " m apart in this state; start from a run with the same joint, or take the "
                      "joint away");
  }
}

}  // namespace bem
