#pragma once

#include "dynamics/corner_loads.hpp"
#include "dynamics/displacement_rate.hpp"
#include "dynamics/frame_offset.hpp"
#include "dynamics/least_squares.hpp"
#include "dynamics/nodal_forces.hpp"
#include "dynamics/prescribed_load.hpp"
#include "model/nodal_tractions.hpp"

#include <memory>
#include <optional>

namespace bem {

/// The deformation of one body: displacements in its frame, free of rigid motion but for the frame
/// offset, under prescribed loads and forces on single nodes.
///
/// The joint nodes (fixed vertices, handles, joints) are chosen once; forces act on them at every
/// stage. The contact nodes change from step to step; theirs are constant over a step, and their
/// displacements are of interest at its end only.
class ElasticPart {
 public:
  /// `tractions` may be null if nothing ever touches the body, `corners` if no joint node has any,
  /// `centrifugal` (six inputs, as set_centrifugal()) if its rotation does not deform it.
  ElasticPart(const ElasticSystem& system, const NodalTractions* tractions,
              std::vector<int> joint_nodes, std::shared_ptr<const CornerLoads> corners,
              std::shared_ptr<const InputColumns> centrifugal,
              std::shared_ptr<const LeastSquaresCorrection> correction);

  const MotionHistory& motion_history() const { return motion_history_; }
  /// Of the displacements without new loads.
  const SolutionMemory& solution_memory() const { return solution_memory_; }
  /// What the history of everything but the displacements contributes: 3N x components.
  Eigen::MatrixXd history_sums(const std::vector<PrescribedLoad>& loads) const;
  /// Starts a step, without contact nodes, from the displacements without new loads. `leak`: of the
  /// frame offset.
  void begin_step(FreeMotion free, const FrameOffset::Leak& leak);
  void set_contact_nodes(const std::vector<int>& nodes);

  bool has_centrifugal() const { return centrifugal_ != nullptr; }
  /// The body force rho B y at the stages by the entries xx xy xz yy yz zz of B (6 x s) [1/s^2].
  void set_centrifugal(const Eigen::MatrixXd& stages) { centrifugal_stages_ = stages; }
  const Eigen::MatrixXd& centrifugal_stages() const { return centrifugal_stages_; }

  /// Displacements [m] of the joint nodes at the stages (3 per node x s), and of the contact nodes
  /// at the end of the step.
  struct Displacements {
    Eigen::MatrixXd joint;
    Eigen::VectorXd contact;
    Eigen::VectorXd contact_without;  ///< the forces on contact nodes
  };
  Displacements displacements(const std::vector<PrescribedLoad>& loads,
                              const NodalForces& forces) const;

  /// d(displacement at `row_stage`)/d(force of stage `load_stage`) between groups of nodes [m/N].
  /// Forces on contact nodes act at all stages: `load_stage` is ignored for them.
  Eigen::MatrixXd compliance(NodeGroup rows, int row_stage, NodeGroup columns,
                             int load_stage) const;

  const Eigen::MatrixXd& contact_compliance() const { return contact_contact_; }

  /// d(offset)/d(acceleration) between stages [s^2].
  const StageMatrix& offset_gain() const { return offset_.gain(); }

  /// All displacements at the end of the step, 3 per node [m].
  Eigen::VectorXd end_displacement(const std::vector<PrescribedLoad>& loads,
                                   const NodalForces& forces);
  /// Makes the motion last computed by end_displacement() part of the history. With the
  /// least-squares correction this changes the displacements, which are returned with the
  /// accelerations (a', alpha) that the frame has to move by instead of those of the forces.
  struct Corrected {
    Eigen::VectorXd displacement;
    Vector6 acceleration;
  };
  std::optional<Corrected> end_step();

  /// How fast the displacements change at the end of the last step [m/s].
  Eigen::VectorXd velocity() const { return rate_.value(); }

  /// Nodal tractions of forces at the end of the step are added [Pa, body axes].
  void add_nodal_tractions(const NodalForces& forces, Eigen::Matrix3Xd& tractions) const;

  /// Between two steps: these two histories of a body that has them, and in visit_state() all else.
  /// Compliances come again by themselves.
  LagHistory& centrifugal_history() { return centrifugal_history_; }
  LagHistory& corner_history() { return corner_history_; }
  void visit_state(StateArchive& state);
  /// What these histories are of: inputs at corners, none without any, and nodes with tractions.
  LoadShape corner_shape() const { return corners_ ? corners_->shape : LoadShape(); }
  std::vector<int> touched_nodes() const { return traction_history_.nodes(); }

 private:
  Corrected correct() const;
  Eigen::VectorXd displacement_at(Eigen::Index stage, const Eigen::MatrixXd& offsets) const;
  template <class F>
  void for_each_input(const std::vector<PrescribedLoad>& loads, const F& f) const;
  NodalLoad nodal_load(const NodalForces& forces) const;
  Eigen::MatrixXd corner_load(const NodalForces& forces) const;
  Eigen::MatrixXd differences(const SpectralState& state, const std::vector<PrescribedLoad>& loads,
                              const NodalLoad& nodal, const Eigen::MatrixXd& corner) const;
  Vector6 predicted_acceleration(const std::vector<PrescribedLoad>& loads,
                                 const NodalForces& forces) const;
  Eigen::MatrixXd unit_accelerations(NodeGroup columns) const;
  Eigen::MatrixXd lift(const std::vector<int>& rows, const Eigen::MatrixXd& accelerations) const;
  bool is_corner(NodeGroup group, std::size_t i) const {
    return group == NodeGroup::joint && corners_ && corners_->input_of(i) >= 0;
  }
  struct UnitTractions;
  UnitTractions unit_tractions(int component, const std::vector<int>& rows,
                               NodeGroup columns) const;
  Eigen::MatrixXd balanced_acceleration(NodeGroup columns) const;
  Eigen::MatrixXd response(NodeGroup rows, int row_stage, NodeGroup columns,
                           const StageVector& pattern) const;
  StageVector pattern(NodeGroup group, int stage) const;
  const std::vector<int>& nodes(NodeGroup group) const {
    return group == NodeGroup::joint ? joint_nodes_ : contact_nodes_;
  }

  const ElasticSystem& system_;
  const NodalTractions* tractions_;
  std::vector<double> areas_;  ///< int phi_i, all nodes
  std::vector<int> joint_nodes_, contact_nodes_;
  std::shared_ptr<const CornerLoads> corners_;
  std::shared_ptr<const InputColumns> centrifugal_;
  std::shared_ptr<const LeastSquaresCorrection> correction_;  ///< null: projection
  FrameOffset offset_;
  FrameOffset::Leak leak_;
  DisplacementRate rate_;
  MotionHistory motion_history_;
  LagHistory acceleration_history_, corner_history_, centrifugal_history_;
  Eigen::MatrixXd centrifugal_stages_;
  NodalHistory traction_history_;
  SolutionMemory solution_memory_;
  SpectralState free_;
  /// Compliances that displacements() needs; those among joint nodes last for the whole run.
  std::vector<Eigen::MatrixXd> joint_joint_, joint_contact_, contact_joint_;
  Eigen::MatrixXd contact_contact_;
  std::vector<int> compliance_nodes_;  ///< that the compliances of contact nodes belong to
  /// The step as last computed by end_displacement().
  struct End {
    NodalLoad load;
    Eigen::MatrixXd corner;  ///< tractions of corners at the stages [Pa]
    Eigen::MatrixXd displacements, accelerations, differences;
    Vector6 predicted;  ///< accelerations by the forces, for the least-squares correction
  } end_;
};

}  // namespace bem
