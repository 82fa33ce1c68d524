#include "coarse_meshes.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace bem {
namespace {

using Json = nlohmann::ordered_json;

/// The first vertex of the input mesh that is this node.
int input_vertex(const BodyGeometry& g, int node) {
  return static_cast<int>(std::find(g.node_of_vertex.begin(), g.node_of_vertex.end(), node) -
                          g.node_of_vertex.begin());
}

}  // namespace

CoarseMeshes::CoarseMeshes(const Plan& plan) {
  for (const PlannedBody& body : plan.bodies)
    watches_.emplace_back(body.archive->kind() == ModelKind::rigid
                              ? 0
                              : static_cast<Eigen::Index>(body.archive->unknowns()));
}

void CoarseMeshes::prepare(const Simulation& simulation) {
  for (const Body& body : simulation.bodies()) {
    if (body.is_rigid()) continue;
    std::unique_ptr<const Coarseness>& coarseness = of_model_[&body.model()];
    if (!coarseness) coarseness = std::make_unique<Coarseness>(body.model().geometry.nodes);
  }
}

void CoarseMeshes::record(const Simulation& simulation) {
  constexpr long kAllUpTo = 256, kInterval = 8;  // steps
  if (simulation.steps() > kAllUpTo && simulation.steps() % kInterval != 0) return;
  for (std::size_t i = 0; i < watches_.size(); ++i) {
    const Body& body = simulation.bodies()[i];
    if (!body.is_rigid())
      watches_[i].record(*of_model_.at(&body.model()), body.displacement(), simulation.time());
  }
}

Json CoarseMeshes::json(const Simulation& simulation, std::size_t body) const {
  const BodyModel& model = simulation.bodies()[body].model();
  const CoarsenessWatch& watch = watches_[body];
  if (simulation.bodies()[body].is_rigid()) return nullptr;
  const Coarseness& mesh = *of_model_.at(&model);
  const double deformation = watch.largest().deformation / std::sqrt(mesh.area());
  Json out{{"reconstructed_part", watch.reconstructed_part()},
           {"largest_deformation", deformation}};
  if (!watch.is_deformed()) return out;
  const Refinement refinement = mesh.halving(watch.displacement());
  const WorstEdge worst = mesh.worst_edge(watch.displacement());
  const BodyGeometry& g = model.geometry;
  const Vec3 at = worst.midpoint + g.mass.centre;
  out["nodes"] = g.nodes.vertices.size();
  out["nodes_to_halve"] = refinement.nodes;
  out["triangles_to_halve"] = refinement.triangles;
  out["where"] = {
      {"time", watch.time()},
      {"edge", {input_vertex(g, worst.vertices[0]), input_vertex(g, worst.vertices[1])}},
      {"mesh_point", {at[0], at[1], at[2]}},
      {"share", worst.bubble / deformation}};
  return out;
}

}  // namespace bem
