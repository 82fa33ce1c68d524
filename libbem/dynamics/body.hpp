#pragma once

#include "assembly/row_assembler.hpp"
#include "dynamics/bilateral.hpp"
#include "dynamics/rigid_frame.hpp"
#include "dynamics/surface_load.hpp"

#include <memory>

namespace bem {

/// What bodies of the same archive share.
struct SharedModel {
  std::shared_ptr<const BodyModel> model;
  std::shared_ptr<const ElasticSystem> system;
  std::shared_ptr<const RowAssembler> assembler;  ///< only if some body carries prescribed loads
  TractionData tractions;  ///< of the nodes that any of the bodies prescribes
};

/// How well the constraints of a step were met.
struct SolveStatistics {
  int iterations = 0;
  double residual = 0;  ///< largest distance of a prescribed node from its place [m]
};

/// One body in motion.
class Body {
 public:
  Body(const BodySpec& spec, const SharedModel& shared, double dt, const Vec3& gravity);

  /// A step, in the phases whose times are reported. Each may throw ErrorCode::numerical.
  void begin_step();         ///< products with the history: displacements without new loads
  void solve_constraints();  ///< frame, loads and unknown tractions of the new step
  void end_step();           ///< displacements of the new step; the history moves on

  const std::string& name() const { return spec_.name; }
  const BodyModel& model() const { return *shared_.model; }
  const RigidFrame& frame() const { return frame_; }
  const SolveStatistics& statistics() const { return statistics_; }
  std::size_t prescribed() const { return constraints_ ? constraints_->size() : 0; }
  std::size_t loads() const { return loads_.size(); }

  /// World positions [m] of the input mesh's vertices.
  std::vector<Vec3> positions() const;
  /// World tractions [Pa] at the input mesh's vertices: prescribed loads (averaged over the
  /// triangles around a vertex) and the reactions of prescribed nodes.
  std::vector<Vec3> tractions() const;
  /// Displacements in body axes, 3 per node [m].
  const Eigen::VectorXd& displacement() const { return displacement_; }
  Vec3 linear_momentum() const { return frame_.mass() * frame_.velocity(); }

 private:
  struct Load {
    std::unique_ptr<SurfaceLoad> load;
    LagHistory history;
    Eigen::MatrixXd stages;  ///< inputs x s of the current step
  };

  double stage_time(int stage) const;
  void evaluate_loads(const std::vector<Mat3>& rotations);
  RigidFrame::Stages move_frame(const std::vector<Mat3>& rotations) const;
  Eigen::MatrixXd acceleration_differences(const SpectralState& state) const;
  Eigen::MatrixXd gaps(const RigidFrame::Stages& stages, const Eigen::MatrixXd& displacements,
                       const Eigen::MatrixXd& offsets) const;
  void choose_leak();
  void follow_holder();
  void set_lean(const std::vector<Mat3>& rotations, const std::vector<Vec3>& turns);

  BodySpec spec_;
  SharedModel shared_;
  const ElasticSystem& system_;
  double dt_;
  RigidFrame frame_;
  Vec3 start_centre_;
  Mat3 start_rotation_;
  FrameOffset offset_;
  RigidFrame::Drag drag_;
  std::vector<Mat3> holder_rotations_;  ///< since the start, at the stages
  std::vector<Load> loads_;
  std::unique_ptr<BilateralConstraints> constraints_;
  LagHistory displacement_history_, acceleration_history_, traction_history_;
  Eigen::MatrixXd tractions_;  ///< of the prescribed nodes, unknowns x s
  Eigen::VectorXd displacement_;
  SpectralState state_;
  RigidFrame::Stages stages_;
  SolveStatistics statistics_;
};

}  // namespace bem
