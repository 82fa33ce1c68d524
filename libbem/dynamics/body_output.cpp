#include "base/error.hpp"
#include "dynamics/body.hpp"

// What a body shows of its motion.

namespace bem {
namespace {

/// Of motions that have no meaning any more.
std::string cures(const BodyModel& model) {
  const bool galerkin = model.discretisation.is_galerkin();
  return std::string(
             "if its loads or handles do that, make them smaller or its material stiffer, "
             "or cut it into parts that welds join; if not, its motion is unstable: make "
             "its archive with ") +
         (galerkin ? "a smaller --codec-tol or --quadrature-tol"
                   : "--discretisation galerkin, with --window auto (or a smaller window)") +
         ", a larger --dt or a finer mesh";
}

}  // namespace

Impulses Body::impulses() const {
  Impulses out;
  if (!has_inertia()) return out;
  out.gravity = frame_.mass() * dt_ * frame_.gravity();
  std::vector<Vec3> loads(stage_count_, Vec3::Zero());
  for (int a = 0; a < stage_count_; ++a)
    for (const PrescribedLoad& p : loads_)
      loads[a] += force_rotation_[a] * (p.load.force() * p.stages.col(a));
  out.loads = frame_.impulse_of(loads);
  if (!frame_stages_.drag.empty()) out.window = frame_.impulse_of(frame_stages_.drag);
  return out;
}

std::vector<Vec3> Body::node_positions() const {
  const std::vector<Vec3>& x = shared_.model->geometry.nodes.vertices;
  const RigidFrame::Stages now = frame_.current();
  std::vector<Vec3> out;
  out.reserve(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    out.push_back(
        frame_.place(now, 0, x[i], displacement_.segment<3>(static_cast<Eigen::Index>(3 * i))));
  return out;
}

std::vector<Vec3> Body::positions() const {
  const BodyGeometry& g = shared_.model->geometry;
  const RigidFrame::Stages now = frame_.current();
  const std::vector<Vec3> nodes = node_positions();
  std::vector<Vec3> out;
  out.reserve(g.input.vertices.size());
  for (std::size_t v = 0; v < g.input.vertices.size(); ++v) {
    const int node = g.node_of_vertex[v];
    if (node < 0)  // no triangle uses it: it goes with the frame
      out.push_back(frame_.place(now, 0, g.input.vertices[v] - g.mass.centre, Vec3::Zero()));
    else
      out.push_back(nodes[node]);
  }
  return out;
}

std::vector<Vec3> Body::tractions() const {
  const BodyGeometry& g = shared_.model->geometry;
  Eigen::Matrix3Xd nodal =
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(g.nodes.vertices.size()));
  for (const PrescribedLoad& p : loads_)
    p.load.add_nodal_tractions(p.stages.col(p.stages.cols() - 1), nodal);
  if (elastic_ && !frame_stages_.rotation.empty())
    elastic_->add_nodal_tractions(nodal_forces(), nodal);
  std::vector<Vec3> out;
  for (int node : g.node_of_vertex)
    out.push_back(node < 0 ? Vec3(Vec3::Zero()) : Vec3(frame_.rotation() * nodal.col(node)));
  return out;
}

/// The nodes at the end of the step as seen from the frame.
std::vector<Vec3> Body::end_shape() const {
  const int last = stage_count_ - 1;
  const Mat3 to_frame = frame_stages_.rotation[last].transpose();
  const std::vector<Vec3>& x = model().geometry.nodes.vertices;
  std::vector<Vec3> out;
  out.reserve(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 u = end_displacement_.segment<3>(static_cast<Eigen::Index>(3 * i));
    out.emplace_back(
        to_frame * (frame_.place(frame_stages_, last, x[i], u) - frame_stages_.translation[last]));
  }
  return out;
}

/// Stops motions that have no meaning any more.
void Body::check_end() const {
  constexpr double kMostDeformation = 100;  // of the body's extent
  const std::string when = " at t = " + std::to_string(stage_time(stage_count_ - 1)) + " s";
  const RigidFrame::Stages& s = frame_stages_;
  if (!end_displacement_.allFinite() || !s.translation.back().allFinite() ||
      !s.rotation.back().allFinite() || !s.velocity.back().allFinite() ||
      !s.angular_momentum.back().allFinite())
    throw Error(ErrorCode::numerical,
                "body \"" + spec_.name + "\" has non-finite positions" + when);
  if (is_rigid()) return;
  const double most = end_displacement_.cwiseAbs().maxCoeff() / model().geometry.extent;
  if (most > kMostDeformation)
    throw Error(ErrorCode::numerical, "body \"" + spec_.name + "\" is deformed to " +
                                          std::to_string(static_cast<long>(most)) +
                                          " times its size" + when + ": " + cures(model()));
}

void Body::check_inversion() const {
  if (!deformation_.is_inside_out()) return;
  const double volume = deformation_.least_volume().value;
  const double share = deformation_.inverted().value;
  throw Error(ErrorCode::numerical,
              "body \"" + spec_.name + "\" is turned inside out at t = " +
                  std::to_string(stage_time(stage_count_ - 1)) + " s: " +
                  (volume > 0 ? std::to_string(static_cast<long>(100 * share)) +
                                    " % of its surface have gone through zero area"
                              : "its volume is " + std::to_string(volume) + " times that at rest") +
                  ", which linear elasticity does not forbid: " + cures(model()));
}

}  // namespace bem
