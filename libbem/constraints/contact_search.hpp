#pragma once

#include "constraints/collision_scene.hpp"
#include "constraints/constraint_solver.hpp"
#include "constraints/known_contacts.hpp"
#include "constraints/phase_times.hpp"

namespace bem {

/// Finds the contacts of a step and their forces together: contacts are detected for a motion, the
/// motion is solved for with them, and so on until it breaks no others (docs/method.md,
/// "Joints and contact in a step").
class ContactSearch {
 public:
  /// Everything referred to must outlive this.
  ContactSearch(CollisionScene& collisions, ConstraintSolver& solver, std::vector<Body>& bodies,
                const ContactTolerances& tolerances);

  /// Takes the positions at the start of the step from t to t + dt [s].
  void begin_step(double t, double dt) { collisions_.begin_step(t, dt, broken_); }

  /// Contact of the step, from the motion that the joints alone lead to (`joints`: its statistics).
  /// Where it cannot be solved for, friction is left out at first and then added to the motion
  /// without it; in the end the motion is taken that leaves the least penetration. The bodies are
  /// left as they then move. Adds its times to `times`.
  ConstraintStatistics run(const ConstraintStatistics& joints, PhaseTimes& times);

  /// Between two steps. Contacts are found anew in every step, but for broken ones.
  void visit_state(StateArchive& state) { state.resizable(broken_); }

 private:
  /// The best motion of a step so far.
  struct Attempt {
    double penetration = std::numeric_limits<double>::infinity();  ///< [m]
    ConstraintStatistics statistics;
    ConstraintSolver::Solution solution;
    std::vector<ContactKey> broken;  ///< contacts that it breaks
  };
  void solve(double error, PhaseTimes& times);
  void start(bool friction, PhaseTimes& times);
  bool find(bool friction, Attempt& best, PhaseTimes& times);

  CollisionScene& collisions_;
  ConstraintSolver& solver_;
  std::vector<Body>& bodies_;
  ContactTolerances tolerances_;
  KnownContacts known_;
  std::vector<ContactKey> broken_;  ///< contacts that the last step has left broken
  ConstraintStatistics statistics_;
};

}  // namespace bem
