#include "repair/acceptance.hpp"

#include "base/error.hpp"
#include "mesh/self_intersection.hpp"
#include "mesh/solids.hpp"

namespace bem {
namespace {

const std::string kName = "mesh";  // which messages about it begin with

}  // namespace

Acceptance check_acceptance(const TriangleMesh& mesh) {
  Acceptance result;
  try {
    result.surface = make_surface(mesh, kName);
  } catch (const Error& e) {
    if (e.code() != ErrorCode::invalid_input) throw;
    result.refusal = std::string(e.what()).substr(kName.size() + 2);
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
