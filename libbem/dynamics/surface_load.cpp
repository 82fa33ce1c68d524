#include "dynamics/surface_load.hpp"

#include "base/error.hpp"
#include "dynamics/load_columns.hpp"
#include "scene/motion.hpp"
#include "scene/selection.hpp"

#include <map>

namespace bem {

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

SurfaceLoad::SurfaceLoad(const LoadShape& past)
    : over_(true),
      panels_(past.panels()),
      force_(Eigen::Matrix3Xd::Zero(3, past.inputs())),
      torque_(force_) {}

void SurfaceLoad::make_columns(const ElasticSystem& system, const LoadAssembler& assembler) {
  columns_ = load_columns(system, assembler, panels_);
}

Eigen::VectorXd SurfaceLoad::values(double t, const Mat3& rotation) const {
  if (over_) return Eigen::VectorXd::Zero(inputs());
  const double factor = profile_value(spec_.profile, t);
  if (follows_) return Eigen::VectorXd::Constant(1, factor);
  return factor * (rotation.transpose() * std::get<Vec3>(spec_.load));
}

void SurfaceLoad::set_traction(const Vec3& traction) {
  if (follows_)
    throw Error(ErrorCode::usage,
                where(spec_.location) +
                    ": the load turns with its body, so that only its factor can change");
  spec_.load = traction;
  set_factor(1);
}

void SurfaceLoad::add_nodal_tractions(const Eigen::VectorXd& values,
                                      Eigen::Matrix3Xd& tractions) const {
  for (const auto& [node, columns] : nodal_) tractions.col(node) += columns * values;
}

}  // namespace bem
