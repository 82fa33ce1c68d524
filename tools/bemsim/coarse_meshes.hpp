#pragma once

#include "dynamics/coarseness_watch.hpp"
#include "plan.hpp"
#include "simulation/simulation.hpp"

#include <map>
#include <memory>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace bem {

/// How coarse the meshes of a scene's deformable bodies are for what the bodies do.
class CoarseMeshes {
 public:
  explicit CoarseMeshes(const Plan& plan);
  /// Before the first step: what is computed once for every archive. The simulation stays.
  void prepare(const Simulation& simulation);

  /// One more step. Of a long run it looks at every eighth step only: steps of small bodies take
  /// not much longer than this.
  void record(const Simulation& simulation);
  /// What has been found of a body of the scene; null of a rigid one.
  nlohmann::ordered_json json(const Simulation& simulation, std::size_t body) const;

  void visit_state(StateArchive& state) { state(watches_); }

 private:
  std::map<const BodyModel*, std::unique_ptr<const Coarseness>> of_model_;
  std::vector<CoarsenessWatch> watches_;  ///< by body
};

}  // namespace bem
