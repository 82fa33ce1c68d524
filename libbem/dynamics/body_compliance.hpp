#pragma once

#include "dynamics/body.hpp"

namespace bem {

/// How a body answers forces on its constraint nodes in the step that Body::update() has computed.
/// The object refers to the body and is valid until the body changes.
class BodyCompliance {
 public:
  explicit BodyCompliance(const Body& body) : body_(body) {}

  /// d(position at `row_stage`)/d(force of `load_stage`) between groups of nodes, in body axes
  /// [m/N]: 3 rows per node and 3 columns per node. Contact forces act over the whole step, contact
  /// positions are those at its end.
  Eigen::MatrixXd between(NodeGroup rows, int row_stage, NodeGroup columns, int load_stage) const;

  /// How the frame of a free body answers contact forces, at the end of the step and in world axes.
  struct Frame {
    double translation = 0;        ///< [m/N]
    Mat3 rotation = Mat3::Zero();  ///< rotation vector by torque [rad/(N m)]
    Vec3 centre = Vec3::Zero();    ///< about which changes of contact forces turn the body [m]
  };
  Frame contact_frame() const;
  /// World vector [m] from the centre of mass to a contact node, which does not turn with the body
  /// and leaves out what the contact forces deform.
  Vec3 contact_lever(std::size_t i) const;
  /// d(deformation at contact nodes)/d(contact forces) in body axes [m/N]; deformable bodies only.
  const Eigen::MatrixXd& contact_deformation() const;

 private:
  StageMatrix position_by_acceleration() const;
  double contact_gain(int stage) const;

  const Body& body_;
};

}  // namespace bem
