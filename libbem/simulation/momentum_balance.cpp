#include "simulation/momentum_balance.hpp"

namespace bem {
namespace {

Vec3 total_momentum(const std::vector<Body>& bodies) {
  Vec3 sum = Vec3::Zero();
  for (const Body& body : bodies)
    if (body.has_inertia()) sum += body.frame().momentum();
  return sum;
}

/// About the origin of the world.
Vec3 total_angular_momentum(const std::vector<Body>& bodies) {
  Vec3 sum = Vec3::Zero();
  for (const Body& body : bodies)
    if (body.has_inertia())
      sum += body.frame().translation().cross(body.frame().momentum()) + body.frame().spin();
  return sum;
}

}  // namespace

void MomentumBalance::begin(const std::vector<Body>& bodies) {
  start = end = total_momentum(bodies);
  angular_start = angular_end = total_angular_momentum(bodies);
  scale = start.norm();
}

void MomentumBalance::add_step(const Impulses& step, const std::vector<Body>& bodies) {
  impulses += step;
  scale += step.sum_of_norms();
  end = total_momentum(bodies);
  angular_end = total_angular_momentum(bodies);
}

}  // namespace bem
