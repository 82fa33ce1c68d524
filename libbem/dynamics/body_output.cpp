#include "dynamics/body_output.hpp"

namespace bem {

Impulses BodyOutput::impulses() const {
  Impulses out;
  if (!body_.has_inertia()) return out;
  out.gravity = body_.frame().mass() * body_.dt() * body_.frame().gravity();
  std::vector<Vec3> loads(body_.stages(), Vec3::Zero());
  for (int a = 0; a < body_.stages(); ++a)
    for (const PrescribedLoad& p : body_.loads())
      loads[a] += body_.step().force_rotation[a] * (p.load.force() * p.stages.col(a));
  out.loads = body_.frame().impulse_of(loads);
  if (!body_.step().frame.drag.empty())
    out.window = body_.frame().impulse_of(body_.step().frame.drag);
  return out;
}

std::vector<Vec3> BodyOutput::node_positions() const {
  const std::vector<Vec3>& x = body_.model().geometry.nodes.vertices;
  const RigidFrame::Stages now = body_.frame().current();
  std::vector<Vec3> out;
  out.reserve(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    out.push_back(body_.frame().place(
        now, 0, x[i], body_.displacement().segment<3>(static_cast<Eigen::Index>(3 * i))));
  return out;
}

std::vector<Vec3> BodyOutput::positions() const {
  const BodyGeometry& g = body_.model().geometry;
  const RigidFrame::Stages now = body_.frame().current();
  const std::vector<Vec3> nodes = node_positions();
  std::vector<Vec3> out;
  out.reserve(g.input.vertices.size());
  for (std::size_t v = 0; v < g.input.vertices.size(); ++v) {
    const int node = g.node_of_vertex[v];
    if (node < 0)  // no triangle uses it: it goes with the frame
      out.push_back(body_.frame().place(now, 0, g.input.vertices[v] - g.mass.centre, Vec3::Zero()));
    else
      out.push_back(nodes[node]);
  }
  return out;
}

std::vector<Vec3> BodyOutput::node_tractions() const {
  const BodyGeometry& g = body_.model().geometry;
  Eigen::Matrix3Xd nodal =
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(g.nodes.vertices.size()));
  for (const PrescribedLoad& p : body_.loads())
    p.load.add_nodal_tractions(p.stages.col(p.stages.cols() - 1), nodal);
  if (!body_.is_rigid() && !body_.step().frame.rotation.empty())
    body_.elastic()->add_nodal_tractions(body_.step().nodal_forces(), nodal);
  std::vector<Vec3> out;
  for (Eigen::Index node = 0; node < nodal.cols(); ++node)
    out.emplace_back(body_.frame().rotation() * nodal.col(node));
  return out;
}

std::vector<Vec3> BodyOutput::tractions() const {
  const std::vector<Vec3> nodal = node_tractions();
  std::vector<Vec3> out;
  for (int node : body_.model().geometry.node_of_vertex)
    out.push_back(node < 0 ? Vec3(Vec3::Zero()) : nodal[node]);
  return out;
}

}  // namespace bem
