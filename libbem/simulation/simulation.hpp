#pragma once

#include "contact/collision_scene.hpp"
#include "simulation/known_contacts.hpp"

#include <optional>

namespace bem {

/// CPU-independent wall-clock seconds per phase, summed over all steps.
struct PhaseTimes {
  double unconstrained = 0;  ///< products with the history, motion without contact
  double collision = 0;      ///< detection
  double constraints = 0;    ///< frame, loads, joints and contacts
  double correction = 0;     ///< displacements of the new step, history
  void visit_state(StateArchive& state) {
    state(unconstrained, collision, constraints, correction);
  }
};

/// Loads what a scene needs of its files.
class ModelSource {
 public:
  virtual ~ModelSource() = default;
  /// The model with the matrices of free motion, for an archive path as resolved in the scene.
  virtual std::shared_ptr<const BodyModel> model(const FilePath& archive) = 0;
  /// Traction columns of some nodes, ascending.
  virtual TractionData tractions(const FilePath& archive, const std::vector<int>& nodes) = 0;
  /// The surface of an obstacle in its mesh's coordinates times its scale.
  virtual const ObstacleSurface& obstacle(const MeshObstacle& obstacle) = 0;
};

/// A scene in motion. Bit-identical for any number of threads.
class Simulation {
 public:
  /// Loads every archive once. Throws ErrorCode::archive if one does not fit the scene.
  Simulation(const Scene& scene, ModelSource& source);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  void step();
  /// Saves the state between two steps, or restores it into a simulation of the same scene and
  /// archives (its duration may be another): it goes on as if it had never stopped, in every bit.
  void visit_state(StateArchive& state);
  double time() const { return static_cast<double>(steps_) * scene_.time_step; }
  long steps() const { return steps_; }
  const std::vector<Body>& bodies() const { return bodies_; }
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
  std::size_t matrix_bytes() const { return matrix_bytes_; }
  std::size_t archives() const { return archives_; }

 private:
  void load(ModelSource& source);
  std::vector<int> touched_nodes(const std::vector<int>& users, const BodyModel& model) const;
  void begin_step();
  /// The best motion of a step so far.
  struct Attempt {
    double penetration = std::numeric_limits<double>::infinity();  ///< [m]
    ConstraintStatistics statistics;
    ConstraintSolver::Solution solution;
    std::vector<ContactKey> broken;  ///< contacts that it breaks
  };
  template <class Detect>
  std::vector<ContactPair> timed(const Detect& detect);
  void solve_contacts(double goal);
  void start_contacts(bool friction);
  bool find_contacts(bool friction, Attempt& best);
  void collide();
  Vec3 total_momentum() const;
  Vec3 total_angular_momentum() const;
  void end_step();

  Scene scene_;
  JointPlan plan_;
  std::vector<Body> bodies_;
  std::vector<std::vector<int>> sharing_;  ///< deformable bodies by archive
  std::optional<ConstraintSolver> constraints_;
  std::optional<CollisionScene> collisions_;
  std::vector<CollisionScene::Overlap> overlaps_;
  KnownContacts contacts_;
  std::vector<ContactKey> broken_;  ///< contacts that the last step has left broken
  ConstraintStatistics statistics_;
  MomentumBalance momentum_;
  PhaseTimes times_;
  long steps_ = 0;
  std::size_t matrix_bytes_ = 0, archives_ = 0;
};

/// Throws ErrorCode::archive, naming the place in the scene, if the archive of a body was made for
/// another time step than the scene's, or for another correction than the body's.
void check_archive(const Scene& scene, const BodySpec& body, ModelKind kind,
                   const Discretisation& discretisation);

/// The time discretisations of a scene's bodies in their order, from those of the deformable ones;
/// rigid bodies (null) take that of the first. Throws ErrorCode::archive, naming the place in the
/// scene, if a joint connects bodies with different ones.
std::vector<Scheme> body_schemes(const Scene& scene,
                                 const std::vector<const Discretisation*>& deformable);

/// Number of steps of a scene: duration / time step, rounded to the nearest.
long step_count(double duration, double time_step);

}  // namespace bem
