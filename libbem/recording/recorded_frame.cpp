#include "base/error.hpp"
#include "dynamics/body_output.hpp"
#include "mesh/describe.hpp"
#include "recording/body_series.hpp"
#include "recording/recorder.hpp"
#include "scene/motion.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

Eigen::MatrixXd columns(const std::vector<Vec3>& vectors) {
  Eigen::MatrixXd out(3, static_cast<Eigen::Index>(vectors.size()));
  for (std::size_t i = 0; i < vectors.size(); ++i)
    out.col(static_cast<Eigen::Index>(i)) = vectors[i];
  return out;
}

std::vector<double> numbers(const Eigen::MatrixXd& values) {
  return {values.data(), values.data() + values.size()};
}

RigidPlace place_of(const MeshObstacle& obstacle, double time) {
  const RigidMotion motion = motion_at(obstacle.motion, time);
  return {motion.apply(obstacle.position), motion.rotation * obstacle.rotation.matrix()};
}

/// Velocities of points that go with a surface: the derivative of where they go, by the change
/// over a time in which the surface moves by a small part of its size.
std::vector<Vec3> bound_velocities(const BoundMesh& mesh, const std::vector<Vec3>& positions,
                                   const std::vector<Vec3>& velocities) {
  constexpr double kPart = 1e-6;
  double fastest = 0, size = 0;
  for (const Vec3& v : velocities) fastest = std::max(fastest, v.norm());
  for (const Vec3& x : positions) size = std::max(size, (x - positions[0]).norm());
  if (fastest == 0) return std::vector<Vec3>(mesh.binding().size(), Vec3::Zero());
  const double time = kPart * size / fastest;
  const auto after = [&](double t) {
    std::vector<Vec3> moved = positions;
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += t * velocities[i];
    return mesh.shape(std::move(moved)).positions;
  };
  const std::vector<Vec3> before = after(-time);
  std::vector<Vec3> out = after(time);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = (out[i] - before[i]) / (2 * time);
  return out;
}

/// What is on the disk is always finite.
void check_finite(const std::string& name, const BodyFrame& frame, double time) {
  const auto vectors = [](const std::vector<Vec3>& all) {
    return std::all_of(all.begin(), all.end(), [](const Vec3& v) { return v.allFinite(); });
  };
  const auto values = [](const std::vector<double>& all) {
    return std::all_of(all.begin(), all.end(), [](double x) { return std::isfinite(x); });
  };
  if (!vectors(frame.positions) || !vectors(frame.normals) ||
      !std::all_of(frame.fields.begin(), frame.fields.end(), values) || !values(frame.series) ||
      !frame.frame.translation.allFinite() || !frame.frame.rotation.allFinite())
    throw Error(ErrorCode::numerical,
                "body " + in_quotes(name) +
                    " has a number that is not finite at t = " + to_text(time) + " s");
}

}  // namespace

RigidPlace place_of(const BodySpec& spec, const Body& body) {
  if (spec.is_stationary()) return {spec.position, spec.rotation.matrix()};
  const Mat3& rotation = body.frame().rotation();
  return {body.frame().translation() - rotation * body.model().geometry.mass.centre, rotation};
}

std::vector<ContactFrame> contact_frames(const Simulation& simulation) {
  std::vector<std::vector<Vec3>> nodes(simulation.bodies().size());
  const auto place = [&](int body, const SurfacePoint& point) {
    if (nodes[body].empty()) nodes[body] = BodyOutput(simulation.bodies()[body]).node_positions();
    return point.place(nodes[body]);
  };
  std::vector<ContactFrame> out;
  for (std::size_t c = 0; c < simulation.contacts().size(); ++c) {
    const ContactPair& pair = simulation.contacts()[c];
    const Vec3 point =
        pair.body_a >= 0 ? place(pair.body_a, pair.contact.a) : place(pair.body_b, pair.contact.b);
    out.push_back({point,
                   pair.contact.normal,
                   simulation.contact_forces()[c],
                   {pair.in_scene_a, pair.in_scene_b}});
  }
  return out;
}

std::vector<double> body_series_of(const Body& body, int index,
                                   const std::vector<ContactFrame>& contacts) {
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  for (const ContactFrame& c : contacts)
    for (int side : {0, 1}) {
      if (c.surface[side] != index) continue;
      const Vec3 f = side == 0 ? c.force : Vec3(-c.force);
      force += f;
      torque += (c.point - body.frame().translation()).cross(f);
    }
  return series_values(body, force, torque);
}

/// By field of the trajectory but velocities, which come first: a column for each node.
std::vector<Eigen::MatrixXd> Recorder::node_fields(std::size_t index, const Body& body) const {
  const BodyOutput output(body);
  std::vector<Eigen::MatrixXd> out;
  if (writes(OutputField::tractions)) out.push_back(columns(output.node_tractions()));
  if (stress_[index]) {
    const StressField stress = output.node_stress(*stress_[index]);
    Eigen::MatrixXd equivalent(1, stress.cols());
    for (Eigen::Index i = 0; i < stress.cols(); ++i) equivalent(i) = von_mises(stress.col(i));
    out.push_back(stress);
    out.push_back(equivalent);
  }
  return out;
}

/// Of the simulated surface: values of the nodes at the vertices of the mesh.
BodyFrame Recorder::surface_frame(const Body& body,
                                  const std::vector<Eigen::MatrixXd>& fields) const {
  BodyFrame out;
  out.positions = BodyOutput(body).positions();
  if (writes(OutputField::velocities))
    out.fields.push_back(numbers(columns(BodyOutput(body).velocities())));
  const std::vector<int>& nodes = body.model().geometry.node_of_vertex;
  for (const Eigen::MatrixXd& field : fields) {
    Eigen::MatrixXd values =
        Eigen::MatrixXd::Zero(field.rows(), static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t v = 0; v < nodes.size(); ++v)
      if (nodes[v] >= 0) values.col(static_cast<Eigen::Index>(v)) = field.col(nodes[v]);
    out.fields.push_back(numbers(values));
  }
  return out;
}

/// Of a mesh that goes with the surface.
BodyFrame Recorder::render_frame(const BoundMesh& mesh, const Body& body,
                                 const std::vector<Eigen::MatrixXd>& fields) const {
  const BodyOutput output(body);
  const std::vector<Vec3> nodes = output.node_positions();
  BodyFrame out;
  BoundMesh::Shape shape = mesh.shape(nodes);
  out.positions = std::move(shape.positions);
  out.normals = std::move(shape.normals);
  if (writes(OutputField::velocities))
    out.fields.push_back(numbers(columns(bound_velocities(mesh, nodes, output.node_velocities()))));
  for (const Eigen::MatrixXd& field : fields)
    out.fields.push_back(numbers(mesh.binding().interpolate(field)));
  return out;
}

Frame Recorder::frame(const Simulation& simulation, std::size_t index) const {
  Frame frame;
  frame.index = index;
  frame.step = static_cast<std::size_t>(simulation.steps());
  frame.time = simulation.time();
  const std::vector<ContactFrame> contacts = contact_frames(simulation);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const ShownBody& shown = bodies_[i];
    const Body& body = simulation.bodies()[i];
    const std::vector<Eigen::MatrixXd> fields = node_fields(i, body);
    const std::vector<double> series = body_series_of(body, static_cast<int>(i), contacts);
    const auto add = [&](BodyFrame of) {
      of.frame = place_of(*shown.spec, body);
      of.series = series;
      check_finite(body.name(), of, frame.time);
      frame.bodies.push_back(std::move(of));
    };
    if (shown.shows_surface) {
      BodyFrame surface = surface_frame(body, fields);
      if (!shown.render->mesh()->obj.normals().empty())
        surface.normals = shown.render->shape(BodyOutput(body).node_positions()).normals;
      add(std::move(surface));
    } else if (shown.render) {
      add(render_frame(*shown.render, body, fields));
    }
    if (writes_simulated_surface(shown)) add(surface_frame(body, fields));
  }
  for (std::size_t o = 0; o < contents_.obstacles.size(); ++o) {
    const auto* mesh = std::get_if<MeshObstacle>(&simulation.scene().obstacles[o].shape);
    frame.obstacles.push_back(mesh ? place_of(*mesh, frame.time) : RigidPlace());
  }
  if (contents_.contacts) frame.contacts = contacts;
  return frame;
}

}  // namespace bem
