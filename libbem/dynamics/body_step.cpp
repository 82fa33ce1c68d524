#include "dynamics/body_step.hpp"

namespace bem {

NodalForces BodyStep::nodal_forces() const {
  NodalForces out{forces.joint, forces.contact};
  const Mat3 to_body = frame.rotation.back().transpose();
  for (std::size_t i = 0; i < contact_nodes.size(); ++i) {
    auto f = out.contact.segment<3>(static_cast<Eigen::Index>(3 * i));
    f = to_body * Vec3(f);
  }
  return out;
}

Vec3 BodyStep::contact_force() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < contact_nodes.size(); ++i)
    sum += forces.contact.segment<3>(static_cast<Eigen::Index>(3 * i));
  return sum;
}

}  // namespace bem
