#include "recorded_bodies.hpp"

#include "common/version.hpp"

namespace bem {

std::unique_ptr<Recorder> make_recorder(const Plan& plan) {
  std::vector<ShownBody> bodies;
  for (const PlannedBody& body : plan.bodies)
    bodies.push_back({body.spec, &body.archive->geometry(),
                      &body.archive->discretisation().material, body.archive->user_block().digest,
                      body.render, body.shows_surface,
                      body.archive->kind() == ModelKind::rigid || body.archive->has_energies()});
  std::vector<ShownObstacle> obstacles;
  for (const PlannedObstacle& obstacle : plan.obstacles)
    obstacles.push_back({obstacle.spec, obstacle.surface});
  return std::make_unique<Recorder>(plan.scene, std::move(bodies), obstacles, version_text());
}

}  // namespace bem
