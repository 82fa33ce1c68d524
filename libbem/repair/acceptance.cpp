#include "repair/acceptance.hpp"

#include "base/error.hpp"
#include "mesh/self_intersection.hpp"
#include "mesh/solids.hpp"

namespace bem {

Acceptance check_acceptance(const TriangleMesh& mesh) {
  Acceptance result;
  try {
    result.surface = make_surface(mesh, "mesh");
  } catch (const Error& e) {
    if (e.code() != ErrorCode::invalid_input) throw;
    result.refusal = e.what();
    return result;
  }
  result.solids = find_solids(*result.surface).size();
  result.crossings = find_self_intersections(result.surface->nodes).count;
  return result;
}

TriangleMesh outward(const Acceptance& acceptance) {
  return acceptance.surface->nodes;
}

}  // namespace bem
