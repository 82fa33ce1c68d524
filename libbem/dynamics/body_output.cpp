#include "dynamics/body_output.hpp"

#include "compress/complex_product.hpp"

namespace bem {
namespace {

/// x^T a x/2 of a matrix that is stored as a family of its own.
double half_square(const MatrixFamily& a, const Eigen::VectorXd& x) {
  return 0.5 * x.dot(multiply_real(a, x).col(0));
}

}  // namespace

/// Values of nodes at the vertices of the input mesh. Vertices that no triangle uses go with the
/// frame: `loose` has their values by their places from the centre of mass.
template <class Loose>
std::vector<Vec3> BodyOutput::at_vertices(const std::vector<Vec3>& nodes,
                                          const Loose& loose) const {
  const BodyGeometry& g = body_.model().geometry;
  std::vector<Vec3> out;
  out.reserve(g.input.vertices.size());
  for (std::size_t v = 0; v < g.input.vertices.size(); ++v) {
    const int node = g.node_of_vertex[v];
    out.push_back(node < 0 ? loose(g.input.vertices[v] - g.mass.centre) : nodes[node]);
  }
  return out;
}

bool BodyOutput::has_energies() const {
  return body_.is_rigid() || body_.model().has_energies();
}

double BodyOutput::elastic_energy() const {
  if (body_.is_rigid()) return 0;
  return half_square(*body_.model().energy_stiffness, body_.displacement());
}

double BodyOutput::kinetic_energy() const {
  if (!body_.has_inertia()) return 0;
  const RigidFrame& frame = body_.frame();
  const Vec3 turn = frame.rotation().transpose() * frame.angular_velocity();  // body axes
  const double rigid = 0.5 * frame.mass() * frame.velocity().squaredNorm() +
                       0.5 * turn.dot(body_.model().geometry.mass.inertia * turn);
  if (body_.is_rigid() || body_.model().kind == ModelKind::quasistatic) return rigid;
  return rigid + half_square(*body_.model().energy_mass, body_.elastic()->velocity());
}

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
  const RigidFrame::Stages now = body_.frame().current();
  return at_vertices(node_positions(),
                     [&](const Vec3& x) { return body_.frame().place(now, 0, x, Vec3::Zero()); });
}

std::vector<Vec3> BodyOutput::node_velocities() const {
  const std::vector<Vec3>& x = body_.model().geometry.nodes.vertices;
  const Eigen::VectorXd rates =
      body_.elastic() ? body_.elastic()->velocity()
                      : Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * x.size()));
  std::vector<Vec3> out;
  out.reserve(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(3 * i);
    out.push_back(
        body_.frame().velocity_at(x[i], body_.displacement().segment<3>(at), rates.segment<3>(at)));
  }
  return out;
}

std::vector<Vec3> BodyOutput::velocities() const {
  return at_vertices(node_velocities(), [&](const Vec3& x) {
    return body_.frame().velocity_at(x, Vec3::Zero(), Vec3::Zero());
  });
}

/// In body axes.
Eigen::Matrix3Xd BodyOutput::nodal_tractions() const {
  Eigen::Matrix3Xd nodal =
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(body_.model().nodes()));
  for (const PrescribedLoad& p : body_.loads())
    p.load.add_nodal_tractions(p.stages.col(p.stages.cols() - 1), nodal);
  if (!body_.is_rigid() && !body_.step().frame.rotation.empty())
    body_.elastic()->add_nodal_tractions(body_.step().nodal_forces(), nodal);
  return nodal;
}

std::vector<Vec3> BodyOutput::node_tractions() const {
  const Eigen::Matrix3Xd nodal = nodal_tractions();
  std::vector<Vec3> out;
  for (Eigen::Index node = 0; node < nodal.cols(); ++node)
    out.emplace_back(body_.frame().rotation() * nodal.col(node));
  return out;
}

StressField BodyOutput::node_stress(const SurfaceStress& surface) const {
  if (body_.is_rigid())
    return StressField::Zero(6, static_cast<Eigen::Index>(body_.model().nodes()));
  const double retardation = body_.model().discretisation.damping.time;
  Eigen::VectorXd strained = body_.displacement();
  if (retardation > 0) strained += retardation * body_.elastic()->velocity();
  return rotated(body_.frame().rotation(), surface.at_nodes(strained, nodal_tractions()));
}

std::vector<Vec3> BodyOutput::tractions() const {
  return at_vertices(node_tractions(), [](const Vec3&) { return Vec3(Vec3::Zero()); });
}

}  // namespace bem
