#include "dynamics/elastic_part.hpp"

#include <algorithm>

namespace bem {
namespace {

/// Rigid motions of some nodes.
Eigen::MatrixXd rigid_columns(const std::vector<Vec3>& x, const std::vector<int>& nodes) {
  std::vector<Vec3> points;
  for (int node : nodes) points.push_back(x[node]);
  return rigid_motions(points);
}

/// Accelerations without history are the balanced ones: the frame offset stays zero.
double time_step_of_offset(const BodyModel& model) {
  return model.kind == ModelKind::dynamic ? model.discretisation.dt : 0;
}

}  // namespace

ElasticPart::ElasticPart(const ElasticSystem& system, const NodalTractions* tractions,
                         std::vector<int> joint_nodes, std::shared_ptr<const CornerLoads> corners,
                         std::shared_ptr<const InputColumns> centrifugal,
                         std::shared_ptr<const LeastSquaresCorrection> correction)
    : system_(system),
      tractions_(tractions),
      areas_(vertex_areas(system.model().geometry.nodes)),
      joint_nodes_(std::move(joint_nodes)),
      corners_(std::move(corners)),
      centrifugal_(std::move(centrifugal)),
      correction_(std::move(correction)),
      offset_(system.scheme(), time_step_of_offset(system.model())),
      rate_(system.scheme(), system.model().discretisation.dt,
            static_cast<Eigen::Index>(3 * system.model().nodes())) {
  motion_history_ = system.make_motion_history();
  acceleration_history_ = system.make_history(6);
  if (corners_) corner_history_ = system.make_history(corners_->inputs());
  if (centrifugal_) centrifugal_history_ = system.make_history(6);
  centrifugal_stages_ = Eigen::MatrixXd::Zero(6, system.scheme().stages());
  traction_history_ = NodalHistory(system.scheme(), system.model().discretisation.history_length,
                                   system.model().window);
}

/// f(columns, stage values) of prescribed loads and the centrifugal force.
template <class F>
void ElasticPart::for_each_input(const std::vector<PrescribedLoad>& loads, const F& f) const {
  for (const PrescribedLoad& p : loads) f(p.load.columns(), p.stages);
  if (!centrifugal_stages_.isZero(0)) f(*centrifugal_, centrifugal_stages_);
}

Eigen::MatrixXd ElasticPart::history_sums(const std::vector<PrescribedLoad>& loads) const {
  Eigen::MatrixXd sums =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * system_.model().nodes()),
                            static_cast<Eigen::Index>(system_.model().components()));
  system_.add_input_history(system_.body_force(), acceleration_history_, sums);
  for (const PrescribedLoad& p : loads)
    system_.add_input_history(p.load.columns(), p.history, sums);
  if (tractions_) tractions_->add_history(traction_history_, sums);
  if (corners_) system_.add_input_history(corners_->columns, corner_history_, sums);
  if (centrifugal_) system_.add_input_history(*centrifugal_, centrifugal_history_, sums);
  return sums;
}

void ElasticPart::begin_step(FreeMotion free, const FrameOffset::Leak& leak) {
  free_ = std::move(free.state);
  solution_memory_ = std::move(free.memory);
  const bool other_gain = leak != leak_;
  if (other_gain) offset_.set_leak(leak_ = leak);
  if (!joint_nodes_.empty() && (joint_joint_.empty() || other_gain)) {
    joint_joint_.clear();
    for (int a = 0; a < system_.scheme().stages(); ++a)
      for (int b = 0; b < system_.scheme().stages(); ++b)
        joint_joint_.push_back(
            response(NodeGroup::joint, a, NodeGroup::joint, pattern(NodeGroup::joint, b)));
  }
  if (other_gain) compliance_nodes_.clear();
  contact_nodes_.clear();
}

void ElasticPart::set_contact_nodes(const std::vector<int>& nodes) {
  contact_nodes_ = nodes;
  if (nodes == compliance_nodes_ || nodes.empty()) return;
  compliance_nodes_ = nodes;
  const int stages = system_.scheme().stages(), last = stages - 1;
  const StageVector constant = pattern(NodeGroup::contact, 0);
  contact_contact_ = response(NodeGroup::contact, last, NodeGroup::contact, constant);
  joint_contact_.clear();
  contact_joint_.clear();
  for (int a = 0; a < stages && !joint_nodes_.empty(); ++a) {
    joint_contact_.push_back(response(NodeGroup::joint, a, NodeGroup::contact, constant));
    contact_joint_.push_back(
        response(NodeGroup::contact, last, NodeGroup::joint, pattern(NodeGroup::joint, a)));
  }
}

/// How a unit force is spread over the stages.
StageVector ElasticPart::pattern(NodeGroup group, int stage) const {
  const int stages = system_.scheme().stages();
  if (group == NodeGroup::contact) return StageVector::Ones(stages);
  return StageVector::Unit(stages, stage);
}

/// What unit tractions at nodes of a group do, 3 columns per node: the displacement of some nodes
/// without rigid part, and the frame accelerations z.
struct ElasticPart::UnitTractions {
  Eigen::MatrixXcd displacement, acceleration;
};

ElasticPart::UnitTractions ElasticPart::unit_tractions(int component, const std::vector<int>& rows,
                                                       NodeGroup columns) const {
  const std::vector<int>& loaded = nodes(columns);
  UnitTractions out{tractions_->response(component, rows, loaded),
                    tractions_->acceleration(component, loaded)};
  for (std::size_t j = 0; j < loaded.size(); ++j) {
    if (!is_corner(columns, j)) continue;
    const Eigen::Index to = static_cast<Eigen::Index>(3 * j), from = corners_->input_of(j);
    out.displacement.middleCols<3>(to) =
        corners_->columns.displacement[component](unknowns_of(rows), Eigen::seqN(from, 3));
    out.acceleration.middleCols<3>(to) =
        corners_->columns.acceleration[component].middleCols<3>(from);
  }
  return out;
}

Eigen::MatrixXd ElasticPart::balanced_acceleration(NodeGroup columns) const {
  Eigen::MatrixXd out = tractions_->balanced_acceleration(nodes(columns));
  for (std::size_t j = 0; j < nodes(columns).size(); ++j)
    if (is_corner(columns, j))
      out.middleCols<3>(static_cast<Eigen::Index>(3 * j)) =
          corners_->columns.balanced_acceleration.middleCols<3>(corners_->input_of(j));
  return out;
}

/// (a', alpha) by unit forces at nodes of a group.
Eigen::MatrixXd ElasticPart::unit_accelerations(NodeGroup columns) const {
  const BodyGeometry& g = system_.model().geometry;
  const Mat3 inverse = g.mass.inertia.inverse();
  const std::vector<int>& loaded = nodes(columns);
  Eigen::MatrixXd out(6, 3 * loaded.size());
  for (std::size_t j = 0; j < loaded.size(); ++j) {
    const auto at = static_cast<Eigen::Index>(3 * j);
    out.block<3, 3>(0, at) = Mat3::Identity() / g.mass.mass;
    out.block<3, 3>(3, at) = inverse * cross_matrix(g.nodes.vertices[loaded[j]]);
  }
  return out;
}

/// (a', alpha) by loads and forces, for the least-squares correction.
Vector6 ElasticPart::predicted_acceleration(const std::vector<PrescribedLoad>& loads,
                                            const NodalForces& forces) const {
  const MassProperties& mass = system_.model().geometry.mass;
  Vector6 out = Vector6::Zero();
  for (const PrescribedLoad& p : loads) {
    out.head<3>() += p.load.force() * p.stages.col(0) / mass.mass;
    out.tail<3>() += mass.inertia.inverse() * (p.load.torque() * p.stages.col(0));
  }
  if (forces.joint.size() > 0) out += unit_accelerations(NodeGroup::joint) * forces.joint.col(0);
  if (forces.contact.size() > 0) out += unit_accelerations(NodeGroup::contact) * forces.contact;
  return out;
}

/// Displacements of some nodes by accelerations that the projection has taken out of them.
Eigen::MatrixXd ElasticPart::lift(const std::vector<int>& rows,
                                  const Eigen::MatrixXd& accelerations) const {
  return system_.projection().response(0).real()(unknowns_of(rows), Eigen::all) * accelerations;
}

/// Displacement of some nodes at a stage by unit forces on others: deformation, and the offset from
/// the frame that it causes.
Eigen::MatrixXd ElasticPart::response(NodeGroup rows, int row_stage, NodeGroup columns,
                                      const StageVector& pattern) const {
  const auto& initial = system_.scheme().initial_components();
  const std::vector<int>& loaded = nodes(columns);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * nodes(rows).size(), 3 * loaded.size());
  Eigen::MatrixXd offset = Eigen::MatrixXd::Zero(6, out.cols());
  for (std::size_t c = 0; c < initial.size(); ++c) {
    const Complex factor = initial[c].multiplicity() *
                           (initial[c].right.transpose() * pattern.cast<Complex>()).value();
    const auto [displacement, z] = unit_tractions(static_cast<int>(c), nodes(rows), columns);
    out += (initial[c].left[row_stage] * factor * displacement).real();
    for (int k = 0; k < pattern.size(); ++k)
      offset -= offset_.gain()(row_stage, k) * (initial[c].left[k] * factor * z).real();
    if (correction_) out += lift(nodes(rows), z.real());
  }
  offset -= (offset_.gain().row(row_stage) * pattern).value() * balanced_acceleration(columns);
  if (!correction_)
    out.noalias() += rigid_columns(system_.model().geometry.nodes.vertices, nodes(rows)) * offset;
  for (std::size_t j = 0; j < loaded.size(); ++j)
    out.middleCols<3>(static_cast<Eigen::Index>(3 * j)) /=
        is_corner(columns, j) ? corners_->areas[corners_->shape_of_joint[j]] : areas_[loaded[j]];
  if (correction_) out += lift(nodes(rows), unit_accelerations(columns));
  return out;
}

Eigen::MatrixXd ElasticPart::compliance(NodeGroup rows, int row_stage, NodeGroup columns,
                                        int load_stage) const {
  const int stages = system_.scheme().stages();
  if (rows == NodeGroup::joint && columns == NodeGroup::joint)
    return joint_joint_[row_stage * stages + load_stage];
  if (rows == NodeGroup::joint) return joint_contact_[row_stage];
  if (columns == NodeGroup::joint) return contact_joint_[load_stage];
  return contact_contact_;
}

ElasticPart::Displacements ElasticPart::displacements(const std::vector<PrescribedLoad>& loads,
                                                      const NodalForces& forces) const {
  const Scheme& scheme = system_.scheme();
  const auto& initial = scheme.initial_components();
  const int stages = scheme.stages();
  const std::vector<Vec3>& x = system_.model().geometry.nodes.vertices;
  // without the forces: free motion and prescribed loads
  SpectralState state;
  state.acceleration = free_.acceleration;
  for_each_input(loads, [&](const InputColumns& columns, const Eigen::MatrixXd& values) {
    for (std::size_t c = 0; c < initial.size(); ++c)
      state.acceleration[c] +=
          columns.acceleration[c] * (values.cast<Complex>() * initial[c].right);
  });
  const Eigen::MatrixXd offsets = offset_.stages(differences(state, loads, {}, {}));
  Vector6 lifted = Vector6::Zero();
  if (correction_) lifted = state.acceleration[0].real() + predicted_acceleration(loads, {{}, {}});
  const auto at = [&](const std::vector<int>& nodes, int stage) {
    const std::vector<int> rows = unknowns_of(nodes);
    Eigen::VectorXd u = correction_ ? Eigen::VectorXd(lift(nodes, lifted))
                                    : Eigen::VectorXd(rigid_columns(x, nodes) * offsets.col(stage));
    for (std::size_t c = 0; c < initial.size(); ++c) {
      Eigen::VectorXcd v = free_.displacement[c](rows);
      for_each_input(loads, [&](const InputColumns& columns, const Eigen::MatrixXd& values) {
        v +=
            columns.displacement[c](rows, Eigen::all) * (values.cast<Complex>() * initial[c].right);
      });
      u += initial[c].multiplicity() * (initial[c].left[stage] * v).real();
    }
    return u;
  };
  Displacements out;
  out.joint.resize(static_cast<Eigen::Index>(3 * joint_nodes_.size()), stages);
  for (int a = 0; a < stages && !joint_nodes_.empty(); ++a) {
    out.joint.col(a) = at(joint_nodes_, a);
    for (int b = 0; b < stages; ++b)
      out.joint.col(a).noalias() += joint_joint_[a * stages + b] * forces.joint.col(b);
    if (!contact_nodes_.empty()) out.joint.col(a).noalias() += joint_contact_[a] * forces.contact;
  }
  if (contact_nodes_.empty()) return out;
  out.contact_without = at(contact_nodes_, stages - 1);
  for (int b = 0; b < stages && !joint_nodes_.empty(); ++b)
    out.contact_without.noalias() += contact_joint_[b] * forces.joint.col(b);
  out.contact = out.contact_without;
  out.contact.noalias() += contact_contact_ * forces.contact;
  return out;
}

/// Forces as tractions of the nodes that carry any, ascending; those of corners are zero.
NodalLoad ElasticPart::nodal_load(const NodalForces& forces) const {
  const int stages = system_.scheme().stages();
  NodalLoad load;
  std::vector<int> nodes;
  std::merge(joint_nodes_.begin(), joint_nodes_.end(), contact_nodes_.begin(), contact_nodes_.end(),
             std::back_inserter(nodes));
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  load.stages = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * nodes.size()), stages);
  const auto add = [&](NodeGroup kind, const Eigen::MatrixXd& values) {
    const std::vector<int>& group = this->nodes(kind);
    for (std::size_t i = 0; i < group.size(); ++i) {
      if (is_corner(kind, i)) continue;
      const auto place = std::lower_bound(nodes.begin(), nodes.end(), group[i]) - nodes.begin();
      load.stages.middleRows<3>(3 * place) +=
          values.middleRows<3>(static_cast<Eigen::Index>(3 * i)) / areas_[group[i]];
    }
  };
  add(NodeGroup::joint, forces.joint);
  add(NodeGroup::contact, forces.contact.replicate(1, stages));
  load.nodes = std::move(nodes);
  return load;
}

/// Forces on corners as their tractions, inputs x s.
Eigen::MatrixXd ElasticPart::corner_load(const NodalForces& forces) const {
  if (!corners_) return {};
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(corners_->inputs(), system_.scheme().stages());
  for (std::size_t i = 0; i < joint_nodes_.size(); ++i)
    if (is_corner(NodeGroup::joint, i))
      out.middleRows<3>(corners_->input_of(i)) =
          forces.joint.middleRows<3>(static_cast<Eigen::Index>(3 * i)) /
          corners_->areas[corners_->shape_of_joint[i]];
  return out;
}

/// By how much the frame of the elastic solution accelerates beyond the balanced value (6 x s).
Eigen::MatrixXd ElasticPart::differences(const SpectralState& state,
                                         const std::vector<PrescribedLoad>& loads,
                                         const NodalLoad& nodal,
                                         const Eigen::MatrixXd& corner) const {
  Eigen::MatrixXd e = system_.acceleration_stages(state);
  for_each_input(loads, [&](const InputColumns& columns, const Eigen::MatrixXd& values) {
    system_.subtract_balance(columns, values, e);
  });
  if (tractions_) tractions_->subtract_balance(nodal, e);
  if (corner.size() > 0) system_.subtract_balance(corners_->columns, corner, e);
  return e;
}

Eigen::VectorXd ElasticPart::end_displacement(const std::vector<PrescribedLoad>& loads,
                                              const NodalForces& forces) {
  SpectralState state = free_;
  for_each_input(loads, [&](const InputColumns& columns, const Eigen::MatrixXd& values) {
    system_.add_inputs(columns, values, state);
  });
  end_.load = nodal_load(forces);
  if (tractions_) tractions_->add(end_.load, state);
  end_.corner = corner_load(forces);
  if (corners_) system_.add_inputs(corners_->columns, end_.corner, state);
  end_.displacements = system_.displacement_stages(state);
  end_.accelerations = system_.acceleration_stages(state);
  end_.differences = differences(state, loads, end_.load, end_.corner);
  const Eigen::Index last = end_.displacements.cols() - 1;
  if (correction_) {
    end_.predicted = predicted_acceleration(loads, forces);
    return end_.displacements.col(0) +
           system_.projection().response(0).real() * (end_.predicted - end_.accelerations.col(0));
  }
  return displacement_at(last, offset_.stages(end_.differences));
}

/// Of the step as last computed, with the frame offsets of its stages (6 x s).
Eigen::VectorXd ElasticPart::displacement_at(Eigen::Index stage,
                                             const Eigen::MatrixXd& offsets) const {
  const Vector6 offset = offsets.col(stage);
  Eigen::VectorXd u = end_.displacements.col(stage);
  const std::vector<Vec3>& x = system_.model().geometry.nodes.vertices;
  for (std::size_t i = 0; i < x.size(); ++i)
    u.segment<3>(static_cast<Eigen::Index>(3 * i)) +=
        offset.head<3>() + offset.tail<3>().cross(x[i]);
  return u;
}

/// Takes the rigid motion out of the displacements in the paper's way.
ElasticPart::Corrected ElasticPart::correct() const {
  const Eigen::MatrixXd response = system_.projection().response(0).real();
  const Eigen::VectorXd v = end_.displacements.col(0) - response * end_.accelerations.col(0);
  Corrected out;
  out.acceleration = correction_->accelerations(v + response * end_.predicted, v, end_.predicted);
  out.displacement = v + response * out.acceleration;
  return out;
}

std::optional<ElasticPart::Corrected> ElasticPart::end_step() {
  std::optional<Corrected> corrected;
  if (correction_) {
    corrected = correct();
    end_.displacements = corrected->displacement;
    end_.accelerations = corrected->acceleration;
    rate_.push(end_.displacements);
  } else {
    Eigen::MatrixXd stages(end_.displacements.rows(), end_.displacements.cols());
    const Eigen::MatrixXd offsets = offset_.stages(end_.differences);
    for (Eigen::Index a = 0; a < stages.cols(); ++a) stages.col(a) = displacement_at(a, offsets);
    rate_.push(stages);
  }
  motion_history_.push(system_.without_rounding(end_.displacements));
  acceleration_history_.push(end_.accelerations);
  if (tractions_) traction_history_.push(end_.load);
  if (corners_) corner_history_.push(end_.corner);
  if (centrifugal_) centrifugal_history_.push(centrifugal_stages_);
  offset_.advance(end_.differences);
  return corrected;
}

void ElasticPart::visit_state(StateArchive& state) {
  state(offset_, rate_, motion_history_, acceleration_history_);
  traction_history_.visit_state(state, tractions_);
  state(solution_memory_);
  state.check(solution_memory_.fits(system_.scheme().initial_components().size(),
                                    static_cast<Eigen::Index>(3 * system_.model().nodes())));
}

void ElasticPart::add_nodal_tractions(const NodalForces& forces,
                                      Eigen::Matrix3Xd& tractions) const {
  const auto add = [&](const std::vector<int>& nodes, const auto& values) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      tractions.col(nodes[i]) +=
          values.template segment<3>(static_cast<Eigen::Index>(3 * i)) / areas_[nodes[i]];
  };
  if (!joint_nodes_.empty()) add(joint_nodes_, forces.joint.col(forces.joint.cols() - 1));
  if (!contact_nodes_.empty()) add(contact_nodes_, forces.contact);
}

}  // namespace bem
