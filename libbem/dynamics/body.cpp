#include "dynamics/body.hpp"

#include "base/error.hpp"
#include "base/symmetric_matrix.hpp"
#include "dynamics/end_check.hpp"
#include "dynamics/rotation.hpp"

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

/// int x phi_v over a triangle with the corner v.
Vec3 hat_moment(const TriangleMesh& mesh, const Triangle& t, int v) {
  return triangle_area(mesh, t) / 12 *
         (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]] + mesh.vertices[v]);
}

/// Where forces on joint nodes act: the centroids int x phi_i / int phi_i of their hat functions on
/// their triangles if they are anchored, and else the nodes.
std::vector<Vec3> joint_anchors(const TriangleMesh& mesh, const std::vector<JointNode>& nodes) {
  std::vector<Vec3> moments(mesh.vertices.size(), Vec3::Zero());
  for (const Triangle& t : mesh.triangles)
    for (int v : t) moments[v] += hat_moment(mesh, t, v);
  const std::vector<double> areas = vertex_areas(mesh);
  std::vector<Vec3> out;
  for (const JointNode& n : nodes) {
    Vec3 sum = moments[n.node];
    double area = areas[n.node];
    if (!n.triangles.empty()) {
      sum.setZero();
      area = 0;
      for (int t : n.triangles) {
        sum += hat_moment(mesh, mesh.triangles[t], n.node);
        area += triangle_area(mesh, mesh.triangles[t]) / 3;
      }
    }
    out.push_back(n.anchored ? Vec3(sum / area) : mesh.vertices[n.node]);
  }
  return out;
}

/// How far a frame without inertia yields to forces: so much more than the body deforms that next
/// to nothing is left of them in a step [s^2].
double equilibrium_mobility(const BodyModel& model) {
  constexpr double kTimesDeformation = 1e6;
  const double stiffness = model.discretisation.material.shear_modulus * model.geometry.extent;
  return kTimesDeformation * model.geometry.mass.mass / stiffness;
}

std::vector<int> node_numbers(const std::vector<JointNode>& nodes) {
  std::vector<int> out;
  out.reserve(nodes.size());
  for (const JointNode& n : nodes) out.push_back(n.node);
  return out;
}

}  // namespace

Body::Body(const BodySpec& spec, const SharedModel& shared, double dt, const Vec3& gravity,
           std::vector<JointNode> joint_nodes, std::shared_ptr<const CornerLoads> corners)
    : spec_(spec),
      shared_(shared),
      dt_(dt),
      stage_count_(shared.model->discretisation.scheme.stages()),
      stage_times_(shared.model->discretisation.scheme.stage_times()),
      frame_(shared.model->discretisation.scheme, dt, shared.model->geometry.mass,
             initial_motion(spec, *shared.model, gravity), spec.frame == FrameMotion::stationary),
      start_rotation_(frame_.rotation()),
      joint_nodes_(std::move(joint_nodes)),
      joint_anchors_(joint_anchors(shared.model->geometry.nodes, joint_nodes_)) {
  if (shared_.system)
    elastic_.emplace(*shared_.system, shared_.tractions.get(), node_numbers(joint_nodes_),
                     std::move(corners), spec.has_centrifugal() ? shared_.centrifugal : nullptr,
                     spec.correction == Correction::least_squares ? shared_.correction : nullptr);
  for (const TractionSpec& t : spec_.tractions) {
    PrescribedLoad p{{t, shared_.model->geometry, frame_.rotation()}, {}, {}};
    p.stages = Eigen::MatrixXd::Zero(p.load.inputs(), stage_count_);
    if (elastic_) {
      p.load.make_columns(*shared_.system, *shared_.assembler);
      p.history = shared_.system->make_history(p.load.inputs());
    }
    loads_.push_back(std::move(p));
  }
  step_.forces = no_forces();
  displacement_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * shared.model->nodes()));
}

double Body::stage_time(int stage) const {
  return frame_.time() + dt_ * stage_times_[stage];
}

/// The window acts on slow motions like a shift of s by w, Delta(q)/dt = w.
double Body::window_rate() const {
  const BodyModel& m = *shared_.model;
  const Scheme& scheme = m.discretisation.scheme;
  const double lost = 1 - m.window;
  return (scheme.is_multistep() ? lost + 0.5 * scheme.theta() * lost * lost : -std::log(m.window)) /
         dt_;
}

/// The leak of the frame offset: the window, which shifts s. Free bodies have a slow leak besides,
/// so that the small imbalance of the discretisation cannot accumulate. In the inertial form only
/// the codec's and the rounding of its products remain (by default 7e-6 of the velocity that a push
/// gives a rod): there held bodies have the leak, too, but next to undamped, because a shift of
/// phase makes their slow vibrations grow.
FrameOffset::Leak Body::leak(bool held) const {
  const BodyModel& m = *shared_.model;
  const double traversal = m.geometry.extent / m.discretisation.material.shear_speed();
  const double slow = (m.stiffness ? 0.005 : 0.05) / traversal;
  if (window_rate() >= slow || (held && !m.stiffness))
    return FrameOffset::Leak::critical(window_rate());
  FrameOffset::Leak leak = FrameOffset::Leak::critical(slow);
  constexpr double kDamped = 0.1, kHeldDamped = 0.001;
  if (m.stiffness) leak.damping *= held ? kHeldDamped : kDamped;
  return leak;
}

/// The window on the rigid motion of a held body: a drag relative to its holder.
void Body::set_drag(const std::optional<Holder>& holder) {
  step_.drag = {};
  if (is_rigid() || !holder || shared_.model->window == 1) return;
  step_.drag.rate = window_rate();
  step_.drag.centre = holder->centre;
  step_.drag.velocity = holder->velocity;
  step_.drag.angular_velocity = holder->angular_velocity;
  holder_rotation_.clear();
  for (const Mat3& r : holder->rotation) holder_rotation_.emplace_back(r * start_rotation_);
}

/// How far the frame is turned from its holder at the stages, by its last rotations and, in a
/// stationary frame, turns.
void Body::set_lean(const std::vector<Vec3>& turns) {
  step_.drag.rotation = step_.frame.rotation;
  step_.drag.lean.clear();
  for (int a = 0; a < stage_count_; ++a)
    step_.drag.lean.push_back(
        turns[a] + rotation_log(step_.drag.rotation[a] * holder_rotation_[a].transpose()));
}

void Body::begin_step(FreeMotion free, bool held, const std::optional<Holder>& holder) {
  if (elastic_) elastic_->begin_step(std::move(free), leak(held));
  if (!has_inertia()) frame_.set_mobility(holder ? equilibrium_mobility(model()) : 0);
  set_drag(holder);
  step_.contact_nodes.clear();
  forget_contact_forces();
  stay();
  end_known_ = false;
}

/// Until the first update() everything stays where it is.
void Body::stay() {
  const RigidFrame::Stages now = frame_.current();
  step_.frame.translation.assign(stage_count_, now.translation[0]);
  step_.frame.rotation.assign(stage_count_, now.rotation[0]);
  step_.frame.turn.assign(stage_count_, now.turn[0]);
  step_.frame.angular_momentum.assign(stage_count_, now.angular_momentum[0]);
}

/// Refuses contacts where the archive has no loads.
void Body::check_loadable(const std::vector<int>& nodes) const {
  const BodyModel& m = model();
  if (!elastic_ || m.loads == Loads::all) return;
  for (int node : nodes) {
    if (std::binary_search(m.loaded_nodes.begin(), m.loaded_nodes.end(), node)) continue;
    const std::vector<int>& of_vertex = m.geometry.node_of_vertex;
    const auto vertex = std::find(of_vertex.begin(), of_vertex.end(), node) - of_vertex.begin();
    throw Error(ErrorCode::archive,
                "the body \"" + spec_.name + "\" is touched at vertex " + std::to_string(vertex) +
                    ", where its archive has no loads; make it again with --loads all, or with a "
                    "file that has this vertex");
  }
}

void Body::set_contact_nodes(std::vector<int> nodes) {
  check_loadable(nodes);
  step_.contact_nodes = std::move(nodes);
  forget_contact_forces();
  if (elastic_) elastic_->set_contact_nodes(step_.contact_nodes);
}

std::vector<int> Body::constraint_nodes(NodeGroup group) const {
  return group == NodeGroup::joint ? node_numbers(joint_nodes_) : step_.contact_nodes;
}

ConstraintForces Body::no_forces() const {
  const auto joints = static_cast<Eigen::Index>(3 * joint_nodes_.size()),
             contacts = static_cast<Eigen::Index>(3 * step_.contact_nodes.size());
  return {Eigen::MatrixXd::Zero(joints, stage_count_), Eigen::VectorXd::Zero(contacts),
          Vec3::Zero()};
}

void Body::forget_contact_forces() {
  step_.forces.contact.setZero(static_cast<Eigen::Index>(3 * step_.contact_nodes.size()));
  step_.forces.contact_moment.setZero();
}

Vec3 Body::joint_displacement(std::size_t i, int stage) const {
  if (!elastic_) return Vec3::Zero();
  return step_.displacements.joint.col(stage).segment<3>(static_cast<Eigen::Index>(3 * i));
}

Vec3 Body::contact_displacement(std::size_t i) const {
  if (!elastic_) return Vec3::Zero();
  return step_.displacements.contact.segment<3>(static_cast<Eigen::Index>(3 * i));
}

/// Where the force on a joint node acts, from the centre of mass in body axes. In a moving frame
/// the displacement is part of it: without it the work of the force on the frame would not be what
/// the constraint takes, and large vibrations of held bodies would grow. A stationary frame turns
/// to first order, about the undeformed body.
Vec3 Body::joint_lever(std::size_t i, int stage) const {
  if (joint_nodes_[i].anchored && spec_.is_stationary()) return joint_anchors_[i];
  return joint_anchors_[i] + joint_displacement(i, stage);
}

FrameLoads Body::frame_loads() const {
  FrameLoads out;
  for (int a = 0; a < stage_count_; ++a) {
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    for (const PrescribedLoad& p : loads_) {
      force += p.load.force() * p.stages.col(a);
      torque += p.load.torque() * p.stages.col(a);
    }
    for (std::size_t i = 0; i < joint_nodes_.size(); ++i) {
      const Vec3 f = step_.forces.joint.col(a).segment<3>(static_cast<Eigen::Index>(3 * i));
      force += f;
      torque += joint_lever(i, a).cross(f);
    }
    out.forces.push_back(step_.frame.rotation[a] * force);
    out.torques.push_back(step_.frame.rotation[a] * torque);
  }
  const Vec3 contact = step_.contact_force();
  if (is_rigid()) {
    out.impulse = dt_ * contact;
    out.angular_impulse = dt_ * step_.forces.contact_moment;
    return out;
  }
  // the points that contact forces act at stay where they are, whichever stage the frame is at
  for (int a = 0; a < stage_count_; ++a) {
    out.forces[a] += contact;
    out.torques[a] += step_.forces.contact_moment -
                      (step_.frame.translation[a] - frame_.translation()).cross(contact);
  }
  return out;
}

/// The centrifugal force by the rotation that is known at the stages, no larger than what would
/// stretch the body by about its size. Returns how much it has changed, as a strain.
double Body::set_centrifugal() {
  constexpr double kNegligible = 1e-14, kMost = 1;
  if (!elastic_ || !elastic_->has_centrifugal()) return 0;
  const Material& m = model().discretisation.material;
  const double extent = model().geometry.extent;
  const double strain = m.density * extent * extent / m.shear_modulus;
  Eigen::MatrixXd entries(6, stage_count_);
  for (int a = 0; a < stage_count_; ++a) {
    const Vec3 momentum = step_.frame.rotation[a].transpose() * step_.frame.angular_momentum[a];
    const Vec3 w = frame_.inverse_inertia() * momentum;
    entries.col(a) = symmetric_entries(w.squaredNorm() * Mat3::Identity() - w * w.transpose());
  }
  const double largest = strain * entries.cwiseAbs().maxCoeff();
  if (!(largest > kNegligible)) entries.setZero();
  if (largest > kMost) entries *= kMost / largest;
  const double change = strain * (entries - elastic_->centrifugal_stages()).cwiseAbs().maxCoeff();
  elastic_->set_centrifugal(entries);
  return change;
}

double Body::update(ConstraintForces forces) {
  step_.forces = std::move(forces);
  end_known_ = false;
  // forces that were tried and were too large leave nothing behind
  const auto finite = [](const auto& x) { return x.allFinite(); };
  if (!std::all_of(step_.frame.rotation.begin(), step_.frame.rotation.end(), finite) ||
      !std::all_of(step_.frame.translation.begin(), step_.frame.translation.end(), finite))
    stay();
  for (PrescribedLoad& p : loads_)
    for (int a = 0; a < stage_count_; ++a)
      p.stages.col(a) = p.load.values(stage_time(a), step_.frame.rotation[a]);
  const bool jointed = !joint_nodes_.empty();
  double turn = 0;
  if (jointed) turn = set_centrifugal();
  if (elastic_ && jointed)
    step_.displacements = elastic_->displacements(loads_, step_.nodal_forces());
  step_.force_rotation = step_.frame.rotation;
  if (step_.drag.rate > 0) set_lean(step_.frame.turn);
  step_.frame = frame_.stages(frame_loads(), step_.drag);
  if (elastic_ && !jointed) {
    // the torque of contact forces depends on the translation, the deformation on the rotation that
    // they bring about
    if (!step_.contact_nodes.empty()) {
      step_.force_rotation = step_.frame.rotation;
      step_.frame = frame_.stages(frame_loads(), step_.drag);
    }
    set_centrifugal();
    step_.displacements = elastic_->displacements(loads_, step_.nodal_forces());
  }
  for (int a = 0; a < stage_count_; ++a)
    turn = std::max(turn, (step_.frame.rotation[a] - step_.force_rotation[a]).norm());
  return turn;
}

Vec3 Body::joint_position(std::size_t i, int stage) const {
  return frame_.place(step_.frame, stage,
                      shared_.model->geometry.nodes.vertices[joint_nodes_[i].node],
                      joint_displacement(i, stage));
}

Vec3 Body::contact_position(std::size_t i) const {
  return frame_.place(step_.frame, stage_count_ - 1,
                      shared_.model->geometry.nodes.vertices[step_.contact_nodes[i]],
                      contact_displacement(i));
}

std::vector<Vec3> Body::end_positions() {
  if (!end_known_ && elastic_)
    end_displacement_ = elastic_->end_displacement(loads_, step_.nodal_forces());
  end_known_ = true;
  const std::vector<Vec3>& x = shared_.model->geometry.nodes.vertices;
  std::vector<Vec3> out;
  out.reserve(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    out.push_back(
        frame_.place(step_.frame, stage_count_ - 1, x[i],
                     elastic_ ? Vec3(end_displacement_.segment<3>(static_cast<Eigen::Index>(3 * i)))
                              : Vec3(Vec3::Zero())));
  return out;
}

/// The nodes at the end of the step as seen from the frame.
std::vector<Vec3> Body::end_shape() const {
  const int last = stage_count_ - 1;
  const Mat3 to_frame = step_.frame.rotation[last].transpose();
  const std::vector<Vec3>& x = model().geometry.nodes.vertices;
  std::vector<Vec3> out;
  out.reserve(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 u = end_displacement_.segment<3>(static_cast<Eigen::Index>(3 * i));
    out.emplace_back(to_frame *
                     (frame_.place(step_.frame, last, x[i], u) - step_.frame.translation[last]));
  }
  return out;
}

/// The end of the step as if forces had brought about these accelerations (a', alpha), body axes.
void Body::move_frame_by(const Vector6& acceleration) {
  const MassProperties& mass = model().geometry.mass;
  const Mat3& r = frame_.rotation();
  FrameLoads loads;
  loads.forces = {r * (mass.mass * acceleration.head<3>())};
  loads.torques = {r * (mass.inertia * acceleration.tail<3>())};
  step_.frame = frame_.stages(loads, step_.drag);
}

void Body::end_step() {
  if (elastic_) {
    if (!end_known_) end_displacement_ = elastic_->end_displacement(loads_, step_.nodal_forces());
    const auto corrected = elastic_->end_step();
    if (corrected) {
      move_frame_by(corrected->acceleration);
      end_displacement_ = corrected->displacement;
    }
    for (PrescribedLoad& p : loads_) p.history.push(p.stages);
  }
  const double end = stage_time(stage_count_ - 1);
  check_end(spec_.name, model(), step_.frame, end_displacement_, end);
  if (elastic_) {
    deformation_.record(model().geometry.nodes, end_shape(), end);
    check_inversion(spec_.name, model(), deformation_, end);
    displacement_ = end_displacement_;
  }
  frame_.advance(step_.frame);
}

void Body::visit_state(StateArchive& state) {
  state(frame_, displacement_);
  if (elastic_) state(*elastic_, deformation_, elastic_->centrifugal_history());
  for (PrescribedLoad& p : loads_) state(p.history);
  if (elastic_) state(elastic_->corner_history());
}

}  // namespace bem
