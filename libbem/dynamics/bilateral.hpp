#pragma once

#include "dynamics/frame_offset.hpp"
#include "dynamics/rigid_frame.hpp"
#include "model/elastic_system.hpp"
#include "scene/scene.hpp"

namespace bem {

/// Nodes of a body whose positions are prescribed, with where they have to be.
struct PrescribedNode {
  int node;
  const HandleSpec* handle;  ///< null: fixed where it starts
};

/// Nodes that the scene fixes or moves, ascending. A node that is fixed or handled twice in
/// contradiction throws ErrorCode::invalid_input naming the place in the scene.
std::vector<PrescribedNode> prescribed_nodes(const BodyGeometry& geometry, const BodySpec& spec);

/// Fixed vertices and handles of one body: the unknown nodal tractions that bring the nodes to
/// their places at every stage of a step. Uses the dense compliance matrix of these nodes, which is
/// constant in body axes and factorised once (method 14.7), inside a modified Newton iteration for
/// the rotation of the frame.
class BilateralConstraints {
 public:
  /// `columns`: of all unknowns 3*i + axis of nodes[i].
  BilateralConstraints(std::vector<PrescribedNode> nodes, InputColumns columns,
                       const ElasticSystem& system, const RigidFrame& frame);

  std::size_t size() const { return nodes_.size(); }
  Eigen::Index unknowns() const { return static_cast<Eigen::Index>(3 * nodes_.size()); }
  const std::vector<PrescribedNode>& nodes() const { return nodes_; }
  const InputColumns& columns() const { return columns_; }

  /// Chooses the constraints that hold at the end of a step.
  void activate(double step_end);
  /// Factorises the compliance of the chosen constraints, if the choice has changed.
  void factorise(const RigidFrame& frame, const FrameOffset& offset);
  bool any_active() const { return !active_.empty(); }

  /// Displacements of all prescribed nodes (unknowns x stages) in `state` plus the effect of nodal
  /// tractions (unknowns x stages).
  Eigen::MatrixXd displacements(const SpectralState& state, const Eigen::MatrixXd& tractions) const;

  /// Adds the frame accelerations z that nodal tractions cause to `state`.
  void add_accelerations(const Eigen::MatrixXd& tractions, SpectralState& state) const {
    for (std::size_t c = 0; c < response_.size(); ++c)
      state.acceleration[c] +=
          columns_.acceleration[c] *
          (tractions.cast<Complex>() * system_.scheme().initial_components()[c].right);
  }

  /// World position that node i has to be at, at time t.
  Vec3 target(std::size_t i, double t) const;

  /// Whether the active nodes leave the body no rigid motion: they are not on one line.
  bool hold_all_round() const { return hold_all_round_; }
  /// Rigid motion x -> rotation * x + translation that brings the active nodes from their start
  /// to their targets at time t, as well as possible.
  struct Holder {
    Mat3 rotation;
    Vec3 translation;
  };
  Holder holder(double t) const;

  /// Changes `tractions` so that the active nodes move by `gaps` (unknowns x stages, body axes
  /// [m]).
  void correct(const Eigen::MatrixXd& gaps, Eigen::MatrixXd& tractions) const;
  /// Sets the tractions of released nodes to zero.
  void clear_inactive(Eigen::MatrixXd& tractions) const;
  bool is_active(std::size_t i) const { return is_active_[i]; }

  /// Force [N] and torque about the centre of mass [N m] of nodal tractions in body axes.
  Vec3 force(const Eigen::VectorXd& tractions) const;
  Vec3 torque(const Eigen::VectorXd& tractions) const;

 private:
  Eigen::MatrixXd compliance(const RigidFrame& frame, const FrameOffset& offset) const;
  bool spread_out() const;
  Eigen::Matrix<double, 6, 3> acceleration_difference(int c, int b, int q) const;

  std::vector<PrescribedNode> nodes_;
  InputColumns columns_;
  const ElasticSystem& system_;
  std::vector<Vec3> rest_;                  ///< node positions in body axes
  std::vector<Vec3> start_;                 ///< and in world axes at the start
  std::vector<double> areas_;               ///< int phi_i
  std::vector<Vec3> moments_;               ///< int x phi_i
  std::vector<Eigen::MatrixXcd> response_;  ///< rows of columns_.displacement at the nodes
  std::vector<int> active_;                 ///< indices into nodes_
  std::vector<char> is_active_;
  bool factorised_ = false, hold_all_round_ = false;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

}  // namespace bem
