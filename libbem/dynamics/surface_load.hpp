#pragma once

#include "dynamics/load_shape.hpp"
#include "model/elastic_system.hpp"
#include "scene/scene.hpp"

namespace bem {

/// A prescribed traction of the scene as inputs of the elastic system: one input for a load that
/// turns with the body, three (the world directions seen from the body) for one that does not.
class SurfaceLoad {
 public:
  /// `initial_rotation`: body to world axes at the start.
  SurfaceLoad(const TractionSpec& spec, const BodyGeometry& geometry, const Mat3& initial_rotation);
  /// A load of an earlier scene that is over: its values are zero, its columns are for its history.
  explicit SurfaceLoad(const LoadShape& past);

  /// Integrates the load over its triangles for every node and lag, O(N x triangles); not needed
  /// for rigid bodies.
  void make_columns(const ElasticSystem& system, const LoadAssembler& assembler);

  const InputColumns& columns() const { return columns_; }
  LoadShape shape() const { return {panels_, inputs()}; }
  Eigen::Index inputs() const { return force_.cols(); }

  /// Input values at time t [s] for a body with rotation `rotation`.
  Eigen::VectorXd values(double t, const Mat3& rotation) const;
  /// From now on in place of the profile: a factor on the load of the scene, or, of a load that
  /// does not turn with the body, another traction [Pa, world axes].
  void set_factor(double factor) { spec_.profile = {{0, factor}}; }
  void set_traction(const Vec3& traction);
  /// Whether values() depends on the rotation.
  bool depends_on_rotation() const { return !follows_; }

  /// Total force [N] and torque about the centre of mass [N m] in body axes: 3 x inputs.
  const Eigen::Matrix3Xd& force() const { return force_; }
  const Eigen::Matrix3Xd& torque() const { return torque_; }

  /// Adds the load's nodal tractions (averages over the triangles around a node) [Pa, body axes].
  void add_nodal_tractions(const Eigen::VectorXd& values, Eigen::Matrix3Xd& tractions) const;

 private:
  TractionSpec spec_;
  bool follows_ = true, over_ = false;
  std::vector<PanelLoad> panels_;
  InputColumns columns_;
  Eigen::Matrix3Xd force_, torque_;
  std::vector<std::pair<int, Eigen::Matrix3Xd>> nodal_;  ///< node, 3 x inputs
};

}  // namespace bem
