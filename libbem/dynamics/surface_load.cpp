#include "dynamics/surface_load.hpp"

#include "base/parallel.hpp"
#include "dynamics/selection.hpp"
#include "scene/motion.hpp"

#include <map>

namespace bem {
namespace {

/// The load columns of all nodes: at lag 0 by initial component, and at every later lag.
struct LoadColumns {
  std::vector<Eigen::MatrixXd> lags;
  std::vector<Eigen::MatrixXcd> initial;
};

LoadColumns assemble_columns(const RowAssembler& assembler,
                             const std::vector<RowAssembler::PanelLoad>& loads) {
  const LaneLayout& layout = assembler.layout();
  const Scheme& scheme = assembler.discretisation().scheme;
  const auto n = static_cast<Eigen::Index>(3 * assembler.mesh().vertices.size());
  const Eigen::Index inputs = loads[0].traction.cols();
  LoadColumns out;
  out.lags.assign(layout.count() - layout.initial, Eigen::MatrixXd(n, inputs));
  out.initial.assign(scheme.initial_components().size(), Eigen::MatrixXcd(n, inputs));
  parallel_for(assembler.mesh().vertices.size(), [&](std::size_t i) {
    thread_local RowAssembler::Workspace work;
    const auto row = assembler.assemble_loads(static_cast<int>(i), loads, work);
    const auto first = static_cast<Eigen::Index>(3 * i);
    for (int lane = layout.initial; lane < layout.count(); ++lane)
      out.lags[lane - layout.initial].middleRows<3>(first) = row[lane];
    int lane = 0;
    for (std::size_t c = 0; c < out.initial.size(); ++c) {
      const bool paired = scheme.initial_components()[c].paired;
      auto target = out.initial[c].middleRows<3>(first);
      target = row[lane].cast<Complex>();
      if (paired) target += Complex(0, 1) * row[lane + 1].cast<Complex>();
      lane += paired ? 2 : 1;
    }
  });
  return out;
}

}  // namespace

SurfaceLoad::SurfaceLoad(const TractionSpec& spec, const BodyGeometry& g,
                         const Mat3& initial_rotation)
    : spec_(spec), follows_(spec.follow || spec.is_pressure()) {
  const Eigen::Index inputs = follows_ ? 1 : 3;
  force_ = torque_ = Eigen::Matrix3Xd::Zero(3, inputs);
  std::map<int, Eigen::Matrix3Xd> nodal;
  for (int t : select_triangles(g, spec.select)) {
    const Triangle& triangle = g.nodes.triangles[t];
    Eigen::Matrix3Xd traction;
    if (spec.is_pressure())
      traction = -std::get<double>(spec.load) * triangle_normal(g.nodes, triangle);
    else if (follows_)
      traction = initial_rotation.transpose() * std::get<Vec3>(spec.load);
    else
      traction = Mat3::Identity();
    const double area = triangle_area(g.nodes, triangle);
    force_ += area * traction;
    torque_ += area * cross_matrix(triangle_centroid(g.nodes, triangle)) * traction;
    for (int v : triangle) {
      auto [entry, fresh] = nodal.try_emplace(v, Eigen::Matrix3Xd::Zero(3, inputs));
      entry->second += area / 3 * traction;
    }
    panels_.push_back({t, traction});
  }
  const std::vector<double> areas = vertex_areas(g.nodes);
  for (auto& [node, traction] : nodal) nodal_.emplace_back(node, traction / areas[node]);
}

void SurfaceLoad::make_columns(const ElasticSystem& system, const RowAssembler& assembler) {
  LoadColumns columns = assemble_columns(assembler, panels_);
  columns_ = system.make_columns(std::move(columns.lags), columns.initial);
}

Eigen::VectorXd SurfaceLoad::values(double t, const Mat3& rotation) const {
  const double factor = profile_value(spec_.profile, t);
  if (follows_) return Eigen::VectorXd::Constant(1, factor);
  return factor * (rotation.transpose() * std::get<Vec3>(spec_.load));
}

void SurfaceLoad::add_nodal_tractions(const Eigen::VectorXd& values,
                                      Eigen::Matrix3Xd& tractions) const {
  for (const auto& [node, columns] : nodal_) tractions.col(node) += columns * values;
}

}  // namespace bem
