#pragma once

#include "dynamics/constraint_forces.hpp"
#include "dynamics/corner_loads.hpp"
#include "dynamics/deformation_watch.hpp"
#include "dynamics/elastic_part.hpp"
#include "dynamics/impulses.hpp"
#include "dynamics/rigid_frame.hpp"

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
/// start, so that a contact ends without rebound).
class Body {
 public:
  using Group = ElasticPart::Group;

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
  SolutionMemory& solution_memory() { return elastic_->solution_memory(); }

  /// Starts a step from the displacements without new loads (rigid bodies: none). `held`: joints
  /// hold the body in the world; `holder`: they leave it no rigid motion but this.
  void begin_step(SpectralState free, bool held, const std::optional<Holder>& holder);
  /// Chooses the nodes in contact; their forces are zero after it.
  void set_contact_nodes(std::vector<int> nodes);

  const std::vector<JointNode>& joint_nodes() const { return joint_nodes_; }
  const std::vector<int>& contact_nodes() const { return contact_nodes_; }
  /// Forces of zero on these nodes.
  ConstraintForces no_forces() const;

  /// Moves frame and constraint nodes under the current loads and these forces, whose directions
  /// depend on the rotations of the last call. Returns how much these have changed [rad].
  double update(ConstraintForces forces);

  /// After update(): world positions of constraint nodes [m] and rotation of the frame.
  Vec3 joint_position(std::size_t i, int stage) const;
  Vec3 contact_position(std::size_t i) const;
  const Mat3& rotation(int stage) const { return frame_stages_.rotation[stage]; }
  /// The rotation that update() has given directions in body axes, known before it.
  const Mat3& force_rotation(int stage) const { return force_rotation_[stage]; }

  /// d(position at `row_stage`)/d(force of `load_stage`) between groups of nodes, in body axes
  /// [m/N]; contact forces act over the whole step, contact positions are those at its end.
  Eigen::MatrixXd compliance(Group rows, int row_stage, Group columns, int load_stage) const;

  /// How the frame of a free body answers contact forces, at the end of the step and in world axes.
  struct FrameCompliance {
    double translation = 0;        ///< [m/N]
    Mat3 rotation = Mat3::Zero();  ///< rotation vector by torque [rad/(N m)]
    Vec3 centre = Vec3::Zero();    ///< about which changes of contact forces turn the body [m]
  };
  FrameCompliance contact_frame_compliance() const;
  /// Where a contact node is from the centre of mass, without what its contact forces deform, which
  /// does not turn with the body; world axes.
  Vec3 contact_lever(std::size_t i) const;
  /// d(deformation at contact nodes)/d(contact forces) in body axes; deformable bodies only [m/N].
  const Eigen::MatrixXd& contact_deformation() const { return elastic_->contact_compliance(); }

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
  std::size_t loads() const { return loads_.size(); }

  /// World positions [m] of the nodes, and of the input mesh's vertices.
  std::vector<Vec3> node_positions() const;
  std::vector<Vec3> positions() const;
  /// World tractions [Pa] at the input mesh's vertices: prescribed loads (averaged over the
  /// triangles around a vertex) and the forces of constraints.
  std::vector<Vec3> tractions() const;
  /// Displacements in body axes, 3 per node [m].
  const Eigen::VectorXd& displacement() const { return displacement_; }
  const DeformationWatch& deformation() const { return deformation_; }
  Vec3 linear_momentum() const { return frame_.mass() * frame_.velocity(); }
  /// Gravity, loads and window in the step that update() has computed.
  Impulses impulses() const;

  /// Between two steps.
  void visit_state(StateArchive& state);

 private:
  bool is_quasistatic() const { return model().kind == ModelKind::quasistatic; }
  void check_end() const;
  void check_inversion() const;
  std::vector<Vec3> end_shape() const;
  void check_loadable(const std::vector<int>& nodes) const;
  double stage_time(int stage) const;
  double set_centrifugal();
  void forget_contact_forces();
  void stay();
  FrameLoads frame_loads() const;
  double contact_gain() const;
  Vec3 contact_force() const;
  void move_frame_by(const Vector6& acceleration);
  NodalForces nodal_forces() const;
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
  FrameDrag drag_;
  std::vector<Mat3> holder_rotation_;  ///< body to world axes if the holder carried it along
  std::optional<ElasticPart> elastic_;
  std::vector<PrescribedLoad> loads_;
  std::vector<JointNode> joint_nodes_;
  std::vector<Vec3> anchor_levers_;  ///< by joint node: where its traction acts, in body axes
  std::vector<int> contact_nodes_;
  ConstraintForces forces_;
  RigidFrame::Stages frame_stages_;
  std::vector<Mat3> force_rotation_;
  ElasticPart::Displacements node_displacements_;
  Eigen::VectorXd displacement_, end_displacement_;
  bool end_known_ = false;
  DeformationWatch deformation_;
};

}  // namespace bem
