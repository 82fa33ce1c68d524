#include "dynamics/body.hpp"

// How a body answers forces on its constraint nodes.

namespace bem {

/// Way of the frame at the end of the step by a unit acceleration of contact forces [s^2].
double Body::contact_gain() const {
  if (is_rigid()) return dt_ * dt_ * stage_times_[stage_count_ - 1];
  const StageMatrix gains =
      drag_.rate > 0 ? elastic_->offset_gain() : frame_.position_by_acceleration();
  return gains.row(stage_count_ - 1).sum();
}

Body::FrameCompliance Body::contact_frame_compliance() const {
  const Mat3& r = frame_stages_.rotation.back();
  FrameCompliance out;
  out.translation = contact_gain() / frame_.mass();
  out.rotation = contact_gain() * r * frame_.inverse_inertia() * r.transpose();
  // a force that moves the body shortens the arms of all others
  out.centre = is_rigid()
                   ? frame_.translation()
                   : Vec3(frame_stages_.translation.back() - out.translation * contact_force());
  return out;
}

Vec3 Body::contact_lever(std::size_t i) const {
  Vec3 x = shared_.model->geometry.nodes.vertices[contact_nodes_[i]];
  if (elastic_)
    x += node_displacements_.contact_without.segment<3>(static_cast<Eigen::Index>(3 * i));
  return frame_stages_.rotation.back() * x;
}

Eigen::MatrixXd Body::compliance(Group rows, int row_stage, Group columns, int load_stage) const {
  const std::vector<Vec3>& x = shared_.model->geometry.nodes.vertices;
  const auto node = [&](Group g, std::size_t i) {
    return g == Group::joint ? joint_nodes_[i].node : contact_nodes_[i];
  };
  const auto count = [&](Group g) {
    return g == Group::joint ? joint_nodes_.size() : contact_nodes_.size();
  };
  const int stage = rows == Group::contact ? stage_count_ - 1 : row_stage;
  // position of the frame by a unit acceleration
  const StageMatrix gains =
      drag_.rate > 0 ? elastic_->offset_gain() : frame_.position_by_acceleration();
  double gain = 0;
  if (columns == Group::joint)
    gain = gains(stage, load_stage);
  else if (is_rigid())
    gain = dt_ * dt_ * stage_times_[stage];
  else
    gain = gains.row(stage).sum();
  Eigen::MatrixXd turn(3, 3 * count(columns));
  for (std::size_t j = 0; j < count(columns); ++j) {
    const bool anchored = columns == Group::joint && joint_nodes_[j].anchored;
    turn.middleCols<3>(static_cast<Eigen::Index>(3 * j)) =
        gain * frame_.inverse_inertia() *
        cross_matrix(anchored ? anchor_levers_[j] : x[node(columns, j)]);
  }
  Eigen::MatrixXd out = elastic_ ? elastic_->compliance(rows, row_stage, columns, load_stage)
                                 : Eigen::MatrixXd::Zero(3 * count(rows), 3 * count(columns));
  const Mat3 shift = gain / frame_.mass() * Mat3::Identity();
  for (std::size_t i = 0; i < count(rows); ++i) {
    auto row = out.middleRows<3>(static_cast<Eigen::Index>(3 * i));
    row.noalias() -= cross_matrix(x[node(rows, i)]) * turn;
    for (std::size_t j = 0; j < count(columns); ++j)
      row.middleCols<3>(static_cast<Eigen::Index>(3 * j)) += shift;
  }
  return out;
}

}  // namespace bem
