#include "mesh/surface.hpp"

#include "base/interruption.hpp"
#include "mesh/describe.hpp"
#include "mesh/orientation.hpp"
#include "mesh/self_intersection.hpp"
#include "mesh/validate.hpp"
#include "mesh/weld.hpp"

#include <algorithm>
#include <utility>

namespace bem {
namespace {

void warn_unused_vertices(const Surface& surface, const std::string& source,
                          std::vector<std::string>& warnings) {
  const std::vector<int>& node = surface.node_of_vertex;
  const auto first = std::find(node.begin(), node.end(), -1);
  if (first == node.end()) return;
  const auto count = static_cast<std::size_t>(std::count(first, node.end(), -1));
  warnings.push_back(source + ": " + count_text(count, "vertex") + " without a triangle, first " +
                     vertex_text(surface.input, static_cast<int>(first - node.begin())) +
                     ": they move rigidly with the body");
}

void warn_self_intersections(const Surface& surface, const std::string& source,
                             std::vector<std::string>& warnings) {
  const SelfIntersections found = find_self_intersections(surface.nodes);
  if (found.count == 0) return;
  warnings.push_back(
      source + ": the surface intersects itself: " + count_text(found.count, "pair") +
      " of triangles, first " + triangle_text(surface.input, found.first) + " and " +
      triangle_text(surface.input, found.second) + "; the result there is not physical");
}

}  // namespace

Surface make_surface(TriangleMesh input, const std::string& source_name) {
  check_elements(input, source_name);
  Surface surface;
  surface.input = std::move(input);
  Welded welded = weld(surface.input);
  surface.node_of_vertex = std::move(welded.node_of_vertex);
  surface.nodes = std::move(welded.mesh);
  check_interruption();
  check_closed_manifold(surface.input, surface.nodes, source_name);
  warn_unused_vertices(surface, source_name, surface.warnings);
  surface.components = surface_components(surface.nodes);
  orient_outward(surface.input, surface.nodes, surface.components, source_name, surface.warnings);
  check_interruption();
  warn_thin_triangles(surface.input, surface.nodes, source_name, surface.warnings);
  warn_self_intersections(surface, source_name, surface.warnings);
  return surface;
}

}  // namespace bem
