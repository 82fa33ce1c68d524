#pragma once

#include "constraints/constraint_solver.hpp"
#include "simulation/saved_bodies.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bem {

/// The "initial_state" of a scene (docs/scene-format.md): a file, and the bodies that start as they
/// are in it. The scene describes its bodies as it places them, selections, joints and loads
/// included; the state then moves them.
class InitialState {
 public:
  /// Opens the file. Throws, naming the place in the scene, ErrorCode::invalid_input if it cannot
  /// be read or has none of the bodies. The scene must outlive this.
  explicit InitialState(const Scene& scene);

  /// Whether a body of the scene starts from the file.
  bool has(std::size_t body) const;
  /// Throws if bodies cannot start so; `bodies`: all of the scene. To be called before what
  /// follows.
  void check(const std::vector<StartingBody>& bodies) const;
  /// What happens, in one sentence.
  std::string text(const std::vector<StartingBody>& bodies) const;
  /// Nodes of a body that have a past of tractions, ascending.
  std::vector<int> touched(std::size_t body) const;

  /// Puts bodies into their states. What holds bodies in the world (fixed vertices, handles, joints
  /// without a second side) holds them where they are then; only where the state does not differ
  /// from what the scene says, to rounding, it stays as the scene says. Throws
  /// ErrorCode::invalid_input if bodies are apart that a joint connects.
  void apply(JointPlan& plan, std::vector<Body>& bodies, ConstraintSolver& solver) const;

 private:
  std::string name_of(std::size_t body) const { return scene_.bodies[body].name; }
  std::string moment() const;
  void choose_bodies();

  const Scene& scene_;
  const InitialStateSpec& spec_;
  std::unique_ptr<SavedBodies> saved_;
  std::vector<std::size_t> bodies_;  ///< of the scene, ascending
};

}  // namespace bem
