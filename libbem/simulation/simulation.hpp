#pragma once

#include "constraints/contact_search.hpp"
#include "simulation/momentum_balance.hpp"
#include "simulation/scene_loader.hpp"

#include <optional>

namespace bem {

/// A scene in motion. Bit-identical for any number of threads.
class Simulation {
 public:
  /// Loads every archive once. Throws ErrorCode::archive if one does not fit the scene, and what
  /// InitialState does if the scene has an initial state that its bodies cannot take.
  Simulation(const Scene& scene, ModelSource& source);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  void step();
  /// Saves the state between two steps, or restores it into a simulation of the same scene and
  /// archives (its duration may be another): it goes on as if it had never stopped, in every bit.
  void visit_state(StateArchive& state);

  // What may be changed between two steps, from the next step on. Bodies, loads, handles and
  // obstacles are counted as in the scene. None of it is part of the state that visit_state()
  // saves.

  /// A load as SurfaceLoad::set_traction() and set_factor() say.
  void set_traction(std::size_t body, std::size_t load, const Vec3& traction);
  void set_load_factor(std::size_t body, std::size_t load, double factor);
  /// Where the motion of a handle or mesh obstacle is at the end of the next step, from then on:
  /// the rotation and translation of its start, as keyframes have them (`pose.time` is not used).
  /// During the step it goes there at constant speed.
  void move_handle(std::size_t body, std::size_t handle, const Keyframe& pose);
  void move_obstacle(std::size_t obstacle, const Keyframe& pose);
  /// The vertices of a handle are free from the next step on.
  void release_handle(std::size_t body, std::size_t handle);

  double time() const { return static_cast<double>(steps_) * scene_.time_step; }
  long steps() const { return steps_; }
  const std::vector<Body>& bodies() const { return loaded_.bodies; }
  const PhaseTimes& times() const { return times_; }
  const Scene& scene() const { return scene_; }
  /// Of the last step.
  const ConstraintStatistics& statistics() const { return statistics_; }
  /// What is in each other before the first step.
  const std::vector<CollisionScene::Overlap>& overlaps() const { return overlaps_; }
  /// Momentum since the start.
  const MomentumBalance& momentum() const { return momentum_; }
  /// Contacts of the last step and the world forces on their sides a [N].
  const std::vector<ContactPair>& contacts() const { return constraints_->contacts(); }
  const std::vector<Vec3>& contact_forces() const { return constraints_->contact_forces(); }

  void observe_contacts(ContactObserver observer) {
    constraints_->observe_contacts(std::move(observer));
  }

  /// Bytes of the matrices in memory, and how many archives they come from.
  std::size_t matrix_bytes() const { return loaded_.matrix_bytes; }
  std::size_t archives() const { return loaded_.archives; }

 private:
  Motion next_motion(const Motion& motion, Keyframe pose) const;
  void visit_bodies(StateArchive& state);
  void move_freely();
  void end_step();

  Scene scene_;
  LoadedScene loaded_;
  std::optional<ConstraintSolver> constraints_;
  std::optional<CollisionScene> collisions_;
  std::optional<ContactSearch> contacts_;
  std::vector<CollisionScene::Overlap> overlaps_;
  ConstraintStatistics statistics_;
  MomentumBalance momentum_;
  PhaseTimes times_;
  long steps_ = 0;
};

/// Number of steps of a scene: duration / time step, rounded to the nearest.
long step_count(double duration, double time_step);

}  // namespace bem
