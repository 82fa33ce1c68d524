#include "dynamics/body.hpp"

#include "base/error.hpp"
#include "dynamics/rotation.hpp"
#include "dynamics/selection.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

InitialMotion initial_motion(const BodySpec& spec, const BodyModel& model, const Vec3& gravity) {
  InitialMotion m;
  m.rotation = spec.rotation.matrix();
  m.centre = spec.position + m.rotation * model.geometry.mass.centre;
  m.velocity = spec.velocity;
  m.angular_velocity = spec.angular_velocity;
  m.gravity = spec.gravity ? gravity : Vec3(Vec3::Zero());
  return m;
}

Vec3 rigid_displacement(const Vector6& offset, const Vec3& x) {
  return offset.head<3>() + offset.tail<3>().cross(x);
}

/// The columns of some unknowns out of those that were loaded for all bodies of the archive.
InputColumns pick_columns(const ElasticSystem& system, const TractionData& all,
                          const std::vector<PrescribedNode>& nodes) {
  std::vector<Eigen::Index> picked;
  TractionData data;
  for (const PrescribedNode& p : nodes)
    for (int axis = 0; axis < 3; ++axis) {
      const int unknown = 3 * p.node + axis;
      const auto it = std::lower_bound(all.unknowns.begin(), all.unknowns.end(), unknown);
      require(it != all.unknowns.end() && *it == unknown, "the traction columns are loaded");
      picked.push_back(it - all.unknowns.begin());
      data.unknowns.push_back(unknown);
    }
  for (const Eigen::MatrixXd& m : all.lags) data.lags.emplace_back(m(Eigen::all, picked));
  for (const Eigen::MatrixXcd& m : all.response) data.response.emplace_back(m(Eigen::all, picked));
  return system.make_columns(data);
}

}  // namespace

Body::Body(const BodySpec& spec, const SharedModel& shared, double dt, const Vec3& gravity)
    : spec_(spec),
      shared_(shared),
      system_(*shared.system),
      dt_(dt),
      frame_(system_.scheme(), dt, shared.model->geometry.mass,
             initial_motion(spec, *shared.model, gravity), spec.frame == FrameMotion::stationary),
      start_centre_(frame_.translation()),
      start_rotation_(frame_.rotation()),
      offset_(system_.scheme(), dt) {
  const int stages = system_.scheme().stages();
  const auto n = static_cast<Eigen::Index>(3 * shared.model->nodes());
  for (const TractionSpec& t : spec_.tractions) {
    Load load;
    load.load = std::make_unique<SurfaceLoad>(t, system_, *shared.assembler, frame_.rotation());
    load.history = system_.make_history(load.load->inputs());
    load.stages = Eigen::MatrixXd::Zero(load.load->inputs(), stages);
    loads_.push_back(std::move(load));
  }
  const auto nodes = prescribed_nodes(shared.model->geometry, spec_);
  if (!nodes.empty()) {
    constraints_ = std::make_unique<BilateralConstraints>(
        nodes, pick_columns(system_, shared.tractions, nodes), system_, frame_);
    tractions_ = Eigen::MatrixXd::Zero(constraints_->unknowns(), stages);
    traction_history_ = system_.make_history(constraints_->unknowns());
  }
  displacement_history_ = system_.make_history(n);
  acceleration_history_ = system_.make_history(6);
  displacement_ = Eigen::VectorXd::Zero(n);
}

double Body::stage_time(int stage) const {
  return frame_.time() + dt_ * system_.scheme().stage_times()[stage];
}

void Body::begin_step() {
  const auto n = static_cast<Eigen::Index>(3 * shared_.model->nodes());
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, shared_.model->components());
  system_.subtract_displacement_history(displacement_history_, sums);
  system_.add_input_history(system_.body_force(), acceleration_history_, sums);
  for (const Load& load : loads_)
    system_.add_input_history(load.load->columns(), load.history, sums);
  if (constraints_) system_.add_input_history(constraints_->columns(), traction_history_, sums);
  state_ = system_.solve(sums);
}

void Body::evaluate_loads(const std::vector<Mat3>& rotations) {
  for (Load& load : loads_)
    for (std::size_t a = 0; a < rotations.size(); ++a)
      load.stages.col(static_cast<Eigen::Index>(a)) =
          load.load->values(stage_time(static_cast<int>(a)), rotations[a]);
}

/// Frame under the current loads and tractions, whose body axes are turned by `rotations`.
RigidFrame::Stages Body::move_frame(const std::vector<Mat3>& rotations) const {
  std::vector<Vec3> forces, torques;
  for (std::size_t a = 0; a < rotations.size(); ++a) {
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    const auto stage = static_cast<Eigen::Index>(a);
    for (const Load& load : loads_) {
      force += load.load->force() * load.stages.col(stage);
      torque += load.load->torque() * load.stages.col(stage);
    }
    if (constraints_) {
      force += constraints_->force(tractions_.col(stage));
      torque += constraints_->torque(tractions_.col(stage));
    }
    forces.push_back(rotations[a] * force);
    torques.push_back(rotations[a] * torque);
  }
  return frame_.stages(forces, torques, drag_);
}

/// How far the prescribed nodes are from their places, in body axes (unknowns x stages).
Eigen::MatrixXd Body::gaps(const RigidFrame::Stages& stages, const Eigen::MatrixXd& displacements,
                           const Eigen::MatrixXd& offsets) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(displacements.rows(), displacements.cols());
  for (std::size_t i = 0; i < constraints_->size(); ++i) {
    if (!constraints_->is_active(i)) continue;
    const Vec3& x = shared_.model->geometry.nodes.vertices[constraints_->nodes()[i].node];
    const auto row = static_cast<Eigen::Index>(3 * i);
    for (int a = 0; a < displacements.cols(); ++a) {
      const Vec3 u = displacements.col(a).segment<3>(row) + rigid_displacement(offsets.col(a), x);
      const Vec3 position = frame_.place(stages, a, x, u);
      out.col(a).segment<3>(row) =
          stages.rotation[a].transpose() * (constraints_->target(i, stage_time(a)) - position);
    }
  }
  return out;
}

/// By how much the frame of the elastic solution accelerates beyond the balanced value (6 x s). In
/// `state` the effect of all loads and tractions of the step is included.
Eigen::MatrixXd Body::acceleration_differences(const SpectralState& state) const {
  Eigen::MatrixXd e = system_.acceleration_stages(state);
  for (const Load& load : loads_) system_.subtract_balance(load.load->columns(), load.stages, e);
  if (constraints_) system_.subtract_balance(constraints_->columns(), tractions_, e);
  return e;
}

/// The window acts on slow motions like a shift of s by w, Delta(q)/dt = w: a drag on the rigid
/// motion of a held body relative to its holder, and a leak of the offset. A free body has a slow
/// leak besides, so that the small imbalance of the discretisation cannot accumulate.
void Body::choose_leak() {
  constexpr double kLeakPerTraversal = 0.05;
  const BodyModel& m = *shared_.model;
  const Scheme& scheme = system_.scheme();
  const double lost = 1 - m.window;
  const double window =
      (scheme.is_multistep() ? lost + 0.5 * scheme.theta() * lost * lost : -std::log(m.window)) /
      dt_;
  const double traversal = m.geometry.extent / m.discretisation.material.shear_speed();
  const bool held = constraints_ && constraints_->any_active();
  offset_.set_leak(held ? window : std::max(window, kLeakPerTraversal / traversal));
  drag_.rate = held && constraints_->hold_all_round() ? window : 0;
}

/// Where the holder takes the body in the coming step.
void Body::follow_holder() {
  const int stage_count = system_.scheme().stages();
  const double h = 0.01 * dt_;  // for rates of change
  drag_.centre.clear();
  drag_.velocity.clear();
  drag_.angular_velocity.clear();
  holder_rotations_.clear();
  for (int a = 0; a < stage_count; ++a) {
    const double t = stage_time(a);
    const auto now = constraints_->holder(t), before = constraints_->holder(t - h),
               after = constraints_->holder(t + h);
    const Vec3& x = start_centre_;
    drag_.centre.push_back(now.rotation * x + now.translation);
    drag_.velocity.push_back(
        ((after.rotation - before.rotation) * x + after.translation - before.translation) /
        (2 * h));
    drag_.angular_velocity.push_back(rotation_log(after.rotation * before.rotation.transpose()) /
                                     (2 * h));
    holder_rotations_.push_back(now.rotation * start_rotation_);
  }
}

/// How far the frame is turned from the holder at the stages.
void Body::set_lean(const std::vector<Mat3>& rotations, const std::vector<Vec3>& turns) {
  drag_.rotation = rotations;
  drag_.lean.clear();
  for (std::size_t a = 0; a < rotations.size(); ++a)
    drag_.lean.push_back(turns[a] + rotation_log(rotations[a] * holder_rotations_[a].transpose()));
}

void Body::solve_constraints() {
  constexpr int kMostIterations = 50;
  const double tolerance = 1e-11 * shared_.model->geometry.extent;
  const int stage_count = system_.scheme().stages();
  if (constraints_) {
    constraints_->activate(stage_time(stage_count - 1));
    constraints_->clear_inactive(tractions_);
  }
  choose_leak();
  if (constraints_) constraints_->factorise(frame_, offset_);
  if (drag_.rate > 0) follow_holder();
  // Rotations enter the loads and the directions of the forces: iterate from the last ones.
  std::vector<Mat3> rotations(stage_count, frame_.rotation());
  std::vector<Vec3> turns(stage_count, frame_.current().turn[0]);
  double last_residual = std::numeric_limits<double>::infinity();
  for (statistics_ = {};;) {
    ++statistics_.iterations;
    evaluate_loads(rotations);
    if (drag_.rate > 0) set_lean(rotations, turns);
    stages_ = move_frame(rotations);
    double turn = 0;
    for (int a = 0; a < stage_count; ++a)
      turn = std::max(turn, (stages_.rotation[a] - rotations[a]).norm());
    rotations = stages_.rotation;
    turns = stages_.turn;
    if (constraints_ && constraints_->any_active()) {
      SpectralState loaded = state_;
      for (const Load& load : loads_) system_.add_inputs(load.load->columns(), load.stages, loaded);
      const Eigen::MatrixXd u = constraints_->displacements(loaded, tractions_);
      constraints_->add_accelerations(tractions_, loaded);
      const Eigen::MatrixXd gap =
          gaps(stages_, u, offset_.stages(acceleration_differences(loaded)));
      statistics_.residual = gap.cwiseAbs().maxCoeff();
      if (!std::isfinite(statistics_.residual)) break;
      const bool met = statistics_.residual <= tolerance && turn < 1e-12;
      // rounding in the positions ends the progress a little above the tolerance
      const bool stalled =
          statistics_.iterations > 10 && statistics_.residual > 0.5 * last_residual;
      if (met || stalled || statistics_.iterations >= kMostIterations) break;
      last_residual = statistics_.residual;
      constraints_->correct(gap, tractions_);
    } else if (turn < 1e-13 || statistics_.iterations >= kMostIterations) {
      break;
    }
  }
}

void Body::end_step() {
  for (Load& load : loads_) {
    system_.add_inputs(load.load->columns(), load.stages, state_);
    load.history.push(load.stages);
  }
  if (constraints_) {
    system_.add_inputs(constraints_->columns(), tractions_, state_);
    traction_history_.push(tractions_);
  }
  const Eigen::MatrixXd u = system_.displacement_stages(state_);
  const Eigen::MatrixXd e = acceleration_differences(state_);
  displacement_history_.push(u);
  acceleration_history_.push(system_.acceleration_stages(state_));
  const Vector6 offset = offset_.stages(e).col(u.cols() - 1);
  offset_.advance(e);
  displacement_ = u.col(u.cols() - 1);
  const std::vector<Vec3>& x = shared_.model->geometry.nodes.vertices;
  for (std::size_t i = 0; i < x.size(); ++i)
    displacement_.segment<3>(static_cast<Eigen::Index>(3 * i)) += rigid_displacement(offset, x[i]);
  frame_.advance(stages_);
  if (!displacement_.allFinite() || !frame_.translation().allFinite() ||
      !frame_.rotation().allFinite())
    throw Error(ErrorCode::numerical,
                "body \"" + spec_.name +
                    "\" has non-finite positions at t = " + std::to_string(frame_.time()) + " s");
}

std::vector<Vec3> Body::positions() const {
  const BodyGeometry& g = shared_.model->geometry;
  const RigidFrame::Stages now = frame_.current();
  std::vector<Vec3> out;
  out.reserve(g.input.vertices.size());
  for (std::size_t v = 0; v < g.input.vertices.size(); ++v) {
    const int node = g.node_of_vertex[v];
    if (node < 0)  // no triangle uses it: it goes with the frame
      out.push_back(frame_.place(now, 0, g.input.vertices[v] - g.mass.centre, Vec3::Zero()));
    else
      out.push_back(
          frame_.place(now, 0, g.nodes.vertices[node], displacement_.segment<3>(3 * node)));
  }
  return out;
}

std::vector<Vec3> Body::tractions() const {
  const BodyGeometry& g = shared_.model->geometry;
  Eigen::Matrix3Xd nodal =
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(g.nodes.vertices.size()));
  for (const Load& load : loads_)
    load.load->add_nodal_tractions(load.stages.col(load.stages.cols() - 1), nodal);
  if (constraints_)
    for (std::size_t i = 0; i < constraints_->size(); ++i)
      nodal.col(constraints_->nodes()[i].node) +=
          tractions_.col(tractions_.cols() - 1).segment<3>(static_cast<Eigen::Index>(3 * i));
  std::vector<Vec3> out;
  for (int node : g.node_of_vertex)
    out.push_back(node < 0 ? Vec3(Vec3::Zero()) : Vec3(frame_.rotation() * nodal.col(node)));
  return out;
}

}  // namespace bem
