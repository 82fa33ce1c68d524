#include "mesh/components.hpp"

#include "base/interruption.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/winding_number.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

void measure(const TriangleMesh& nodes, Component& component) {
  std::vector<Vec3> corners;
  corners.reserve(3 * component.triangles.size());
  for (int t : component.triangles)
    for (int v : nodes.triangles[t]) corners.push_back(nodes.vertices[v]);
  component.box = bounding_box(corners);
  const Vec3 centre = component.box.centre();
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const Vec3 a = corners[i] - centre, b = corners[i + 1] - centre, c = corners[i + 2] - centre;
    component.volume += a.dot(b.cross(c)) / 6.0;
    component.area += area_vector(a, b, c).norm();
  }
}

/// A point just below the surface of the component, in the region that it encloses.
Vec3 inner_point(const TriangleMesh& nodes, const Component& component, int t) {
  const Triangle& corners = nodes.triangles[t];
  const double depth = (component.volume > 0 ? 1e-6 : -1e-6) * longest_edge(nodes, corners);
  return triangle_centroid(nodes, corners) - depth * triangle_normal(nodes, corners);
}

/// Is `inner` within `outer`? Points just below the surface of `inner` are asked instead of its
/// vertices, which lie in both surfaces where the parts touch. A part that sticks out is not
/// within, but one may cut the other a little, as in scans.
bool lies_within(const TriangleMesh& nodes, const Component& inner, const Component& outer) {
  constexpr std::size_t kMostVotes = 64;
  constexpr double kOutside = 0.05, kMargin = 0.01;  // of the votes, of the size
  if (!contains(widened(outer.box, kMargin * outer.box.diagonal()), inner.box)) return false;
  std::vector<Triangle> shell;
  for (int t : outer.triangles) shell.push_back(nodes.triangles[t]);
  const std::size_t votes = std::min(kMostVotes, inner.triangles.size());
  const auto most = static_cast<std::size_t>(kOutside * static_cast<double>(votes));
  std::size_t outside = 0;
  for (std::size_t vote = 0; vote < votes && outside <= most; ++vote) {
    const int t = inner.triangles[vote * inner.triangles.size() / votes];
    const Vec3 p = inner_point(nodes, inner, t);
    if (!contains(outer.box, {p, p}) || std::abs(winding_number(shell, nodes.vertices, p)) <= 0.5)
      ++outside;
  }
  return outside <= most;
}

void find_depths(const TriangleMesh& nodes, std::vector<Component>& components) {
  const int n = static_cast<int>(components.size());
  std::vector<std::vector<int>> around(n);
  for (int inner = 0; inner < n; ++inner) {
    check_interruption();
    for (int outer = 0; outer < n; ++outer)
      if (inner != outer && lies_within(nodes, components[inner], components[outer]))
        around[inner].push_back(outer);
    components[inner].depth = static_cast<int>(around[inner].size());
  }
  for (int inner = 0; inner < n; ++inner)
    for (int outer : around[inner]) {
      int& parent = components[inner].parent;
      if (parent < 0 || components[outer].depth > components[parent].depth) parent = outer;
    }
}

}  // namespace

std::vector<Component> surface_components(const TriangleMesh& nodes) {
  const std::vector<int> twins = half_edge_twins(nodes.triangles);
  std::vector<char> seen(nodes.triangles.size(), 0);
  std::vector<Component> components;
  for (std::size_t seed = 0; seed < seen.size(); ++seed) {
    if (seen[seed]) continue;
    Component component;
    std::vector<int>& members = component.triangles;
    members.push_back(static_cast<int>(seed));
    seen[seed] = 1;
    for (std::size_t next = 0; next < members.size(); ++next) {
      for (int k = 0; k < 3; ++k) {
        const int neighbour = twins[3 * members[next] + k] / 3;
        if (seen[neighbour]) continue;
        seen[neighbour] = 1;
        members.push_back(neighbour);
      }
    }
    std::sort(members.begin(), members.end());
    measure(nodes, component);
    components.push_back(std::move(component));
  }
  find_depths(nodes, components);
  return components;
}

bool encloses_volume(double volume, double area, double size) {
  constexpr double kZeroVolumeRatio = 1e-10;
  return std::abs(volume) > kZeroVolumeRatio * area * size;
}

void turn_over(TriangleMesh& nodes, Component& component) {
  for (int t : component.triangles) std::swap(nodes.triangles[t][1], nodes.triangles[t][2]);
  component.volume = -component.volume;
}

}  // namespace bem
