#pragma once

#include "constraints/contact_problem.hpp"
#include "constraints/contact_tolerances.hpp"
#include "constraints/known_forces.hpp"
#include "friction/friction_solver.hpp"

#include <functional>

namespace bem {

/// How well the constraints of a step were met.
struct ConstraintStatistics {
  int contacts = 0;
  int iterations = 0;         ///< of the outer iteration for the rotations
  double joint_residual = 0;  ///< largest distance of a joint's points, per axis [m]
  int sweeps = 0;             ///< Gauss-Seidel sweeps of the contact solver, all calls
  int newton_steps = 0;
  double contact_error = 0;     ///< of the last contact solve, relative
  double contact_residual = 0;  ///< what the contacts' displacements are wrong by [m]
  double complementarity = 0;
  double penetration = 0;  ///< left at the contacts [m]
  bool joints_met = true;
  bool contacts_met = true;       ///< contact_residual is within the tolerance
  bool contacts_complete = true;  ///< the motion breaks no contacts but those solved for
  bool infeasible = false;        ///< no forces keep all contacts apart
  bool exhausted = false;         ///< the work allowed for a step was not enough

  bool converged() const { return joints_met && contacts_met && contacts_complete; }
  /// Adds what another solution has taken.
  void add_work(const ConstraintStatistics& other) {
    iterations += other.iterations;
    sweeps += other.sweeps;
    newton_steps += other.newton_steps;
  }
  /// The same statistics for the work of another solution.
  ConstraintStatistics with_work_of(const ConstraintStatistics& other) const;
  void visit_state(StateArchive& state) {
    state(contacts, iterations, sweeps, newton_steps, joints_met, contacts_met, contacts_complete,
          infeasible, exhausted);
    state.any_numbers(joint_residual, contact_error, contact_residual, complementarity,
                      penetration);
  }
};

/// Is shown every contact problem, the forces that its solution started from, and the result.
using ContactObserver =
    std::function<void(const FrictionProblem&, const Eigen::VectorXd&, const FrictionResult&)>;

/// All forces of a step that are not prescribed, solved together: joints at every stage, contact
/// with friction by one force per step. The linear problem is the dense compliance of the nodes
/// concerned; joints are eliminated from it, which leaves one contact problem for all bodies. An
/// outer iteration takes care of the rotations.
class ConstraintSolver {
 public:
  /// `method`: of the contact problems.
  ConstraintSolver(const JointPlan& plan, std::vector<Body>& bodies,
                   const ContactTolerances& tolerances, FrictionMethod method);

  /// What holds a body, which was moved before the first step, holds it where it is now.
  void hold_here(std::size_t body) {
    start_centres_[body] = (*bodies_)[body].frame().translation();
  }

  /// Chooses the joints that hold in the step from t to t + dt [s].
  void begin_step(double t, double dt);
  bool is_held(int body) const { return mechanisms_[mechanism_of_[body]].is_held(); }
  /// What holds a body in the step, if its prescribed nodes leave it no rigid motion of its own.
  std::optional<Holder> holder(int body) const;

  /// Finds the forces under which the bodies, which begin_step() must have started, meet all joints
  /// and the given contacts, the latter to an error of `goal` [m], and leaves the bodies updated.
  /// Starts from the forces of the last call for joints, for contacts with the same key, and for
  /// vertices and edges that have come to another triangle or edge of the same surface.
  ConstraintStatistics solve(const std::vector<ContactPair>& contacts, double goal = 0);

  /// Forces and contacts of a solution, to go back to.
  struct Solution {
    std::vector<ContactPair> contacts;
    std::vector<Vec3> forces;
    std::vector<Eigen::MatrixXd> joint_forces;  ///< by mechanism
  };
  Solution solution() const;
  /// Moves the bodies as they were when `solution` was taken in this step.
  void restore(const Solution& solution);

  /// Adds the impulses of joints to the world and of obstacles in the step as solved [N s].
  void add_impulses(Impulses& sum) const;

  const std::vector<ContactPair>& contacts() const { return placed_.pairs; }  ///< of the last call
  /// World forces on side a of the contacts of the last call [N].
  const std::vector<Vec3>& contact_forces() const { return forces_; }

  /// Between two steps: what the next one starts from.
  void visit_state(StateArchive& state) {
    for (Mechanism& m : mechanisms_) state(m);
    state(known_forces_);
  }

  void observe_contacts(ContactObserver observer) { observer_ = std::move(observer); }

 private:
  /// Where the bodies are under the current forces, and how far from what is asked.
  struct State {
    double turn = 0;                    ///< largest change of a rotation by the last update
    std::vector<Eigen::VectorXd> gaps;  ///< of the joints, by mechanism
    Eigen::VectorXd u;                  ///< displacements of the contacts in their frames
    bool joints_met = true;
    double joint_residual = 0;    ///< [m]
    double contact_residual = 0;  ///< largest natural map of a contact [m]
    double residual() const { return joint_residual + contact_residual; }
  };
  /// A solution of the linear problem: where the forces go from here.
  struct Direction {
    Eigen::VectorXd contacts;             ///< change in the frames of the contacts
    std::vector<Eigen::VectorXd> joints;  ///< by mechanism
  };

  double update();
  State evaluate(const ContactProblem* problem);
  std::vector<Vec3> forces_after(const Direction& direction, double step) const;
  double largest_turn(const std::vector<Vec3>& forces) const;
  void move(const Direction& direction, double step);
  void choose_start();
  ConstraintStatistics solve_joints();
  Direction find_direction(ContactProblem& problem, const State& state, double goal,
                           ConstraintStatistics& statistics);
  State search(const ContactProblem& problem, const Direction& direction, double reference);
  double joint_tolerance(const Mechanism& m) const;
  bool is_exhausted() const { return solves_left_ <= 0 || sweeps_left_ <= 0; }

  std::vector<Body>* bodies_;
  ContactTolerances tolerances_;
  FrictionMethod method_;
  std::vector<Mechanism> mechanisms_;
  std::vector<int> mechanism_of_;    ///< by body
  std::vector<Vec3> start_centres_;  ///< by body: centre of mass at the start of the simulation
  double start_ = 0, dt_ = 0;

  PlacedContacts placed_;
  std::vector<Vec3> forces_;  ///< on side a, world
  bool first_ = true;         ///< contacts have not been solved for in this step
  int solves_left_ = 0;       ///< linear solves of the contact solver in this step
  int sweeps_left_ = 0;       ///< its sweeps
  KnownForces known_forces_;
  ContactObserver observer_;
};

}  // namespace bem
