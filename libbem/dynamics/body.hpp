#pragma once

#include "dynamics/body_step.hpp"
#include "dynamics/deformation_watch.hpp"
#include "dynamics/impulses.hpp"

#include <memory>
#include <optional>

namespace bem {

/// What bodies of the same archive share. A rigid body needs the model alone.
struct SharedModel {
  std::shared_ptr<const BodyModel> model;
  std::shared_ptr<const ElasticSystem> system;
  std::shared_ptr<const LoadAssembler> assembler;   ///< for prescribed loads and those of corners
  std::shared_ptr<const NodalTractions> tractions;  ///< of the nodes that constraints may act on
  std::shared_ptr<const InputColumns> centrifugal;  ///< if rotation deforms some body
  std::shared_ptr<const LeastSquaresCorrection> correction;  ///< if some body is corrected so
};

/// What holds a body in the world: the rigid motion since the start that the prescribed places of
/// its nodes describe, at the stages of a step.
struct Holder {
  std::vector<Mat3> rotation;
  std::vector<Vec3> centre, velocity;  ///< of the body's centre of mass if it were carried along
  std::vector<Vec3> angular_velocity;
};

/// One body in motion. A step: begin_step(), then update() until the forces of the constraints are
/// right, then end_step(). Forces on joint nodes are in body axes and act stage by stage; forces on
/// contact nodes are in world axes and constant over a step (for a rigid body an impulse at its
/// start, so that a contact ends without rebound). BodyCompliance says how the body answers forces,
/// BodyOutput what it shows of its motion.
class Body {
 public:
  /// `joint_nodes` ascending by node; `corners`: those of them that act on some of the triangles
  /// around them, may be null.
  Body(const BodySpec& spec, const SharedModel& shared, double dt, const Vec3& gravity,
       std::vector<JointNode> joint_nodes, std::shared_ptr<const CornerLoads> corners = nullptr);

  bool is_rigid() const { return !elastic_; }
  /// A quasi-static body in a stationary frame has none: it is in equilibrium where joints hold it,
  /// and else stays where it is but for its deformation.
  bool has_inertia() const { return is_rigid() || !is_quasistatic() || !spec_.is_stationary(); }
  int stages() const { return stage_count_; }
  const StageVector& stage_times() const { return stage_times_; }  ///< in units of dt

  /// For deformable bodies: the past, and what of it has to be multiplied by the displacement
  /// matrices of the model.
  const MotionHistory& motion_history() const { return elastic_->motion_history(); }
  Eigen::MatrixXd history_sums() const { return elastic_->history_sums(loads_); }
  const SolutionMemory& solution_memory() const { return elastic_->solution_memory(); }

  /// Starts a step from the displacements without new loads (rigid bodies: none). `held`: joints
  /// hold the body in the world; `holder`: they leave it no rigid motion but this.
  void begin_step(FreeMotion free, bool held, const std::optional<Holder>& holder);
  /// Chooses the nodes in contact; their forces are zero after it.
  void set_contact_nodes(std::vector<int> nodes);

  const std::vector<JointNode>& joint_nodes() const { return joint_nodes_; }
  const std::vector<int>& contact_nodes() const { return step_.contact_nodes; }
  std::vector<int> constraint_nodes(NodeGroup group) const;
  /// Where a force on a joint node acts on the undeformed body, from the centre of mass in its
  /// axes.
  const Vec3& joint_anchor(std::size_t i) const { return joint_anchors_[i]; }
  /// Forces of zero on these nodes.
  ConstraintForces no_forces() const;

  /// Moves frame and constraint nodes under the current loads and these forces, whose directions
  /// depend on the rotations of the last call. Returns how much these have changed [rad].
  double update(ConstraintForces forces);

  /// After update(): world positions of constraint nodes [m] and rotation of the frame.
  Vec3 joint_position(std::size_t i, int stage) const;
  Vec3 contact_position(std::size_t i) const;
  const Mat3& rotation(int stage) const { return step_.frame.rotation[stage]; }
  const BodyStep& step() const { return step_; }

  /// World positions of all nodes at the end of the step that update() has computed.
  std::vector<Vec3> end_positions();
  /// Takes the end of the step as the new state. Throws ErrorCode::numerical if it is not finite,
  /// inside out, or deformed by more than a hundred times the body's extent; place and momentum
  /// remain those before it.
  void end_step();

  const std::string& name() const { return spec_.name; }
  const BodySpec& spec() const { return spec_; }
  const BodyModel& model() const { return *shared_.model; }
  const ElasticSystem& system() const { return *shared_.system; }  ///< deformable bodies only
  const RigidFrame& frame() const { return frame_; }
  double dt() const { return dt_; }
  const std::vector<PrescribedLoad>& loads() const { return loads_; }
  /// Of a load, in the order of the scene's: between two steps it may be given another size.
  SurfaceLoad& load(std::size_t i) { return loads_.at(i).load; }
  const ElasticPart* elastic() const { return elastic_ ? &*elastic_ : nullptr; }  ///< rigid: null

  /// Displacements in body axes, 3 per node [m].
  const Eigen::VectorXd& displacement() const { return displacement_; }
  const DeformationWatch& deformation() const { return deformation_; }
  Vec3 linear_momentum() const { return frame_.mass() * frame_.velocity(); }

  /// Between two steps.
  void visit_state(StateArchive& state);

 private:
  friend class BodyStart;
  bool is_quasistatic() const { return model().kind == ModelKind::quasistatic; }
  std::vector<Vec3> end_shape() const;
  void check_loadable(const std::vector<int>& nodes) const;
  double stage_time(int stage) const;
  double set_centrifugal();
  void forget_contact_forces();
  void stay();
  FrameLoads frame_loads() const;
  void move_frame_by(const Vector6& acceleration);
  Vec3 joint_lever(std::size_t i, int stage) const;
  Vec3 joint_displacement(std::size_t i, int stage) const;
  Vec3 contact_displacement(std::size_t i) const;
  double window_rate() const;
  FrameOffset::Leak leak(bool held) const;
  void set_drag(const std::optional<Holder>& holder);
  void set_lean(const std::vector<Vec3>& turns);

  BodySpec spec_;
  SharedModel shared_;
  double dt_;
  int stage_count_;
  StageVector stage_times_;
  RigidFrame frame_;
  Mat3 start_rotation_;
  std::vector<Mat3> holder_rotation_;  ///< body to world axes if the holder carried it along
  std::optional<ElasticPart> elastic_;
  std::vector<PrescribedLoad> loads_;
  std::vector<JointNode> joint_nodes_;
  std::vector<Vec3> joint_anchors_;  ///< by joint node
  BodyStep step_;
  Eigen::VectorXd displacement_, end_displacement_;
  bool end_known_ = false;
  DeformationWatch deformation_;
};

}  // namespace bem
