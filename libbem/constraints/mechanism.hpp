#pragma once

#include "algebra/block_lu.hpp"
#include "constraints/joint_plan.hpp"
#include "constraints/port.hpp"

#include <memory>

namespace bem {

/// Bodies that joints connect, with the unknown joint forces; a body without joints is a mechanism
/// of its own. Unknowns: 3 per active joint and stage, stage by stage, in the axes of the joint's
/// side a. So the matrix of a single body never changes; it is factorised again only when joints
/// are released, or when the bodies have turned so far against each other that iterations with it
/// no longer converge.
class Mechanism {
 public:
  /// `bodies` and `joints`: indices into `all_bodies` and the plan, which must outlive this.
  Mechanism(std::vector<int> bodies, std::vector<int> joints, const JointPlan& plan,
            std::vector<Body>& all_bodies);

  const std::vector<int>& bodies() const { return bodies_; }
  std::size_t joints() const { return joints_.size(); }

  /// Chooses the joints that hold in a step that ends at `t` [s].
  void activate(double t);
  Eigen::Index unknowns() const { return static_cast<Eigen::Index>(3 * active_.size()) * stages_; }
  /// Whether an active joint connects it with the world.
  bool is_held() const { return held_; }
  /// What the prescribed nodes of one of the bodies make it do in a step from t over dt, see
  /// holder_motion(). `centre`: of the body's mass at the start of the simulation.
  std::optional<Holder> holder(int body, const Vec3& centre, double t, double dt) const;

  /// How far the active joints are from being met in a step from `t` over `dt` [s]: unknowns [m].
  Eigen::VectorXd gaps(double t, double dt) const;
  /// Factorises the matrix for the current rotations unless that has been done in this step.
  /// Returns whether it had to.
  bool refresh();
  /// Force changes that close gaps, or the columns of any other displacements.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& displacements);
  void add_forces(const Eigen::VectorXd& change);
  const Eigen::MatrixXd& forces() const { return forces_; }
  void set_forces(const Eigen::MatrixXd& forces) { forces_ = forces; }
  /// Adds the joint forces to those of the bodies, for the rotations of their last update.
  /// `by_body`: of all bodies.
  void add_forces_to(std::vector<ConstraintForces>& by_body) const;
  /// Between two steps. The factorisation is part of the state: it may be of an earlier step.
  void visit_state(StateArchive& state);
  /// Impulse of the joints that connect the bodies with the world in the step that their last
  /// update has computed [N s].
  Vec3 impulse_from_world() const;

  /// Displacements of the joints by unit contact forces at the ports of one of the bodies, and of
  /// the contacts by unit joint forces, are added to the blocks (unknowns x 3 contacts,
  /// transposed).
  void add_coupling(int body, const std::vector<Port>& contacts,
                    Eigen::MatrixXd& joints_by_contacts, Eigen::MatrixXd& contacts_by_joints) const;

 private:
  std::vector<Port> joint_ports(int body) const;
  std::vector<std::vector<Port>> ports_by_group(int body) const;
  const Mat3& axes(const Joint& joint) const;
  Vec3 place(const Attachment& at, int stage) const;
  int slot(int body, int node) const;
  void arrange();
  void factorise();

  const JointPlan* plan_;
  std::vector<Body>* all_bodies_;
  std::vector<int> bodies_, joints_, active_;  ///< active_: out of joints_
  int stages_ = 1;
  bool held_ = false, fresh_ = false;
  Eigen::MatrixXd forces_;  ///< 3 joints_.size() x s [N]
  /// Joints between the same two bodies are a group, which acts on those of the same bodies alone.
  std::vector<std::vector<int>> groups_;  ///< by group its joints, places in active_
  std::vector<int> rows_;                 ///< by unknown its row, groups one after the other
  std::unique_ptr<BlockLu> factors_;      ///< null until they are needed
};

/// Every body of a scene in its mechanism.
std::vector<Mechanism> make_mechanisms(const JointPlan& plan, std::vector<Body>& bodies);

}  // namespace bem
