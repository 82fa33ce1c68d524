#include "simulation/simulation.hpp"

#include "base/error.hpp"
#include "base/state_section.hpp"
#include "dynamics/body_output.hpp"
#include "dynamics/body_start.hpp"
#include "scene/motion.hpp"
#include "simulation/initial_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bem {
namespace {

double smallest_extent(const std::vector<Body>& bodies) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Body& body : bodies) smallest = std::min(smallest, body.model().geometry.extent);
  return smallest;
}

/// Bodies that joints connect: contact between them is left out.
std::vector<std::pair<int, int>> joined_bodies(const Scene& scene) {
  std::vector<std::pair<int, int>> out;
  for (const JointSpec& j : scene.joints)
    if (j.b) out.emplace_back(static_cast<int>(j.a.body), static_cast<int>(j.b->body));
  return out;
}

std::vector<ObstacleMesh> obstacle_meshes(const Scene& scene, ModelSource& source) {
  std::vector<ObstacleMesh> out;
  for (const ObstacleSpec& o : scene.obstacles)
    if (const auto* mesh = std::get_if<MeshObstacle>(&o.shape))
      out.push_back({&o, source.obstacle(*mesh)});
  return out;
}

}  // namespace

long step_count(double duration, double time_step) {
  return std::lround(duration / time_step);
}

Simulation::Simulation(const Scene& scene, ModelSource& source) : scene_(scene) {
  std::optional<InitialState> initial;
  if (scene_.initial_state) initial.emplace(scene_);
  loaded_ = load_scene(scene_, source, initial ? &*initial : nullptr);
  std::vector<Body>& bodies = loaded_.bodies;
  const ContactTolerances tolerances(scene_.contact.tolerance, smallest_extent(bodies));
  constraints_.emplace(loaded_.plan, bodies, tolerances, scene_.contact.solver);
  if (initial) initial->apply(loaded_.plan, bodies, *constraints_);
  momentum_.begin(bodies);
  if (!scene_.contact.enabled) return;
  collisions_.emplace(scene_, bodies, obstacle_meshes(scene_, source), joined_bodies(scene_),
                      tolerances);
  overlaps_ = collisions_->overlaps();
  contacts_.emplace(*collisions_, *constraints_, bodies, tolerances);
}

/// The motion without new forces: products with the history, once for bodies of the same archive.
void Simulation::move_freely() {
  std::vector<Body>& bodies = loaded_.bodies;
  const auto begin = [&](int b, FreeMotion free) {
    bodies[b].begin_step(std::move(free), constraints_->is_held(b), constraints_->holder(b));
  };
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].is_rigid()) begin(static_cast<int>(b), {});
  for (const std::vector<int>& group : loaded_.sharing) {
    std::vector<const MotionHistory*> motions;
    std::vector<Eigen::MatrixXd> sums;
    for (int b : group) {
      motions.push_back(&bodies[b].motion_history());
      sums.push_back(bodies[b].history_sums());
    }
    const ElasticSystem& system = bodies[group[0]].system();
    system.subtract_motion_history(motions, sums);
    std::vector<SolutionMemory> memories;
    for (int b : group) memories.push_back(bodies[b].solution_memory());
    std::vector<SolutionMemory*> used;
    if (system.model().is_iterative())
      for (SolutionMemory& m : memories) used.push_back(&m);
    std::vector<SpectralState> states = system.solve(sums, motions, used);
    for (std::size_t i = 0; i < group.size(); ++i)
      begin(group[i], {std::move(states[i]), std::move(memories[i])});
  }
}

void Simulation::step() {
  {
    const PhaseStopwatch timer(times_.unconstrained);
    constraints_->begin_step(time(), scene_.time_step);
    if (contacts_) contacts_->begin_step(time(), scene_.time_step);
    move_freely();
  }
  {
    const PhaseStopwatch timer(times_.constraints);
    statistics_ = constraints_->solve({});
  }
  if (contacts_) statistics_ = contacts_->run(statistics_, times_);
  const PhaseStopwatch timer(times_.correction);
  end_step();
}

/// Takes the motion as it is now, and what has brought it about.
void Simulation::end_step() {
  Impulses step;
  for (const Body& body : loaded_.bodies) step += BodyOutput(body).impulses();
  constraints_->add_impulses(step);
  for (Body& body : loaded_.bodies) body.end_step();
  momentum_.add_step(step, loaded_.bodies);
  ++steps_;
}

void Simulation::set_traction(std::size_t body, std::size_t load, const Vec3& traction) {
  loaded_.bodies.at(body).load(load).set_traction(traction);
}

void Simulation::set_load_factor(std::size_t body, std::size_t load, double factor) {
  loaded_.bodies.at(body).load(load).set_factor(factor);
}

Motion Simulation::next_motion(const Motion& motion, Keyframe pose) const {
  pose.time = static_cast<double>(steps_ + 1) * scene_.time_step;
  return motion_to(motion, time(), pose);
}

void Simulation::move_handle(std::size_t body, std::size_t handle, const Keyframe& pose) {
  Motion& motion = scene_.bodies.at(body).handles.at(handle).motion;
  motion = next_motion(motion, pose);
}

void Simulation::move_obstacle(std::size_t obstacle, const Keyframe& pose) {
  auto* mesh = std::get_if<MeshObstacle>(&scene_.obstacles.at(obstacle).shape);
  if (!mesh)
    throw Error(ErrorCode::usage, "the obstacle " + in_quotes(scene_.obstacles[obstacle].name) +
                                      " is a plane, which cannot move: give it a mesh");
  mesh->motion = next_motion(mesh->motion, pose);
}

void Simulation::release_handle(std::size_t body, std::size_t handle) {
  scene_.bodies.at(body).handles.at(handle).release_time = time();
}

void Simulation::visit_state(StateArchive& state) {
  state(steps_);
  visit_bodies(state);
  state(statistics_, momentum_, times_);
  if (contacts_) state(*contacts_);
  state(*constraints_);
}

/// First and each with its size, so that they can be found by who knows nothing of the scene
/// (simulation/saved_bodies.hpp).
void Simulation::visit_bodies(StateArchive& state) {
  std::uint64_t count = loaded_.bodies.size();
  state(count);
  state.check(count == loaded_.bodies.size());
  for (std::size_t b = 0; b < loaded_.bodies.size(); ++b) {
    Body& body = loaded_.bodies[b];
    BodyRecord record = BodyStart::record_of(body, loaded_.digests[b]);
    state(record);
    state.check(record.name == body.name());
    visit_section(state, [&](StateArchive& s) { s(body); });
    state.check(body.frame().step() == steps_);
  }
}

}  // namespace bem
