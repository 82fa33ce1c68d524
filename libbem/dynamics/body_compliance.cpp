#include "dynamics/body_compliance.hpp"

namespace bem {

/// d(position of the frame)/d(acceleration) between stages [s^2].
StageMatrix BodyCompliance::position_by_acceleration() const {
  return body_.step().drag.rate > 0 ? body_.elastic()->offset_gain()
                                    : body_.frame().position_by_acceleration();
}

/// Distance that a unit acceleration of contact forces moves the frame by at a stage [s^2].
double BodyCompliance::contact_gain(int stage) const {
  if (body_.is_rigid()) return body_.dt() * body_.dt() * body_.stage_times()[stage];
  return position_by_acceleration().row(stage).sum();
}

BodyCompliance::Frame BodyCompliance::contact_frame() const {
  const BodyStep& step = body_.step();
  const RigidFrame& frame = body_.frame();
  const Mat3& r = step.frame.rotation.back();
  const double gain = contact_gain(body_.stages() - 1);
  Frame out;
  out.translation = gain / frame.mass();
  out.rotation = gain * r * frame.inverse_inertia() * r.transpose();
  // a force that moves the body shortens the arms of all others
  out.centre = body_.is_rigid()
                   ? frame.translation()
                   : Vec3(step.frame.translation.back() - out.translation * step.contact_force());
  return out;
}

Vec3 BodyCompliance::contact_lever(std::size_t i) const {
  const BodyStep& step = body_.step();
  Vec3 x = body_.model().geometry.nodes.vertices[step.contact_nodes[i]];
  if (!body_.is_rigid())
    x += step.displacements.contact_without.segment<3>(static_cast<Eigen::Index>(3 * i));
  return step.frame.rotation.back() * x;
}

const Eigen::MatrixXd& BodyCompliance::contact_deformation() const {
  return body_.elastic()->contact_compliance();
}

Eigen::MatrixXd BodyCompliance::between(NodeGroup rows, int row_stage, NodeGroup columns,
                                        int load_stage) const {
  const std::vector<Vec3>& x = body_.model().geometry.nodes.vertices;
  const RigidFrame& frame = body_.frame();
  const std::vector<int> row_nodes = body_.constraint_nodes(rows),
                         column_nodes = body_.constraint_nodes(columns);
  const int stage = rows == NodeGroup::contact ? body_.stages() - 1 : row_stage;
  const double gain = columns == NodeGroup::joint ? position_by_acceleration()(stage, load_stage)
                                                  : contact_gain(stage);
  Eigen::MatrixXd turn(3, 3 * column_nodes.size());
  for (std::size_t j = 0; j < column_nodes.size(); ++j) {
    const Vec3& lever = columns == NodeGroup::joint ? body_.joint_anchor(j) : x[column_nodes[j]];
    turn.middleCols<3>(static_cast<Eigen::Index>(3 * j)) =
        gain * frame.inverse_inertia() * cross_matrix(lever);
  }
  Eigen::MatrixXd out = body_.is_rigid()
                            ? Eigen::MatrixXd::Zero(3 * row_nodes.size(), 3 * column_nodes.size())
                            : body_.elastic()->compliance(rows, row_stage, columns, load_stage);
  const Mat3 shift = gain / frame.mass() * Mat3::Identity();
  for (std::size_t i = 0; i < row_nodes.size(); ++i) {
    auto row = out.middleRows<3>(static_cast<Eigen::Index>(3 * i));
    row.noalias() -= cross_matrix(x[row_nodes[i]]) * turn;
    for (std::size_t j = 0; j < column_nodes.size(); ++j)
      row.middleCols<3>(static_cast<Eigen::Index>(3 * j)) += shift;
  }
  return out;
}

}  // namespace bem
