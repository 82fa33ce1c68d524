#include "mesh/orientation.hpp"

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/describe.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

/// A component whose volume is below this part of area times size has none (rounding leaves 1e-16).
constexpr double kZeroVolumeRatio = 1e-10;

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

bool contains(const BoundingBox& box, const Vec3& p, double margin = 0) {
  return (p.array() >= box.min.array() - margin).all() &&
         (p.array() <= box.max.array() + margin).all();
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
  const double margin = kMargin * outer.box.diagonal();
  if (!contains(outer.box, inner.box.min, margin) || !contains(outer.box, inner.box.max, margin))
    return false;
  const std::size_t votes = std::min(kMostVotes, inner.triangles.size());
  const auto most = static_cast<std::size_t>(kOutside * static_cast<double>(votes));
  std::size_t outside = 0;
  for (std::size_t vote = 0; vote < votes && outside <= most; ++vote) {
    const int t = inner.triangles[vote * inner.triangles.size() / votes];
    const Vec3 p = inner_point(nodes, inner, t);
    if (!contains(outer.box, p) || std::abs(winding_number(nodes, outer.triangles, p)) <= 0.5)
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

std::string first_triangle(const TriangleMesh& input, const Component& component) {
  return triangle_text(input, component.triangles.front());
}

void refuse_flat(const TriangleMesh& input, const std::vector<Component>& components,
                 const std::string& source) {
  std::size_t count = 0;
  const Component* first = nullptr;
  for (const Component& c : components) {
    if (std::abs(c.volume) > kZeroVolumeRatio * c.area * c.box.diagonal()) continue;
    if (count++ == 0) first = &c;
  }
  if (count == 0) return;
  throw Error(ErrorCode::invalid_input,
              source + ": zero volume: the part with " + first_triangle(input, *first) +
                  " (counting from 0) encloses nothing; " + count_text(count, "such part") +
                  " in all; give the surface a thickness");
}

}  // namespace

double winding_number(const TriangleMesh& mesh, const std::vector<int>& triangles,
                      const Vec3& point) {
  double half_angles = 0;
  for (int t : triangles) {
    const Triangle& corner = mesh.triangles[t];
    const Vec3 a = mesh.vertices[corner[0]] - point;
    const Vec3 b = mesh.vertices[corner[1]] - point;
    const Vec3 c = mesh.vertices[corner[2]] - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    half_angles +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return half_angles / (2.0 * kPi);
}

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

void orient_outward(const TriangleMesh& input, TriangleMesh& nodes, const std::string& source,
                    std::vector<std::string>& warnings) {
  const std::vector<Component> components = surface_components(nodes);
  refuse_flat(input, components, source);
  std::vector<const Component*> inward, shells;
  for (const Component& c : components) {
    if (c.is_solid() == (c.volume > 0)) continue;
    // a cavity of a part that was turned is turned with it
    const bool alone = !c.is_solid() && components[c.parent].volume > 0;
    (alone ? shells : inward).push_back(&c);
    for (int t : c.triangles) std::swap(nodes.triangles[t][1], nodes.triangles[t][2]);
  }
  const std::string of_all = " of " + std::to_string(components.size()) + ", first the one with ";
  if (!inward.empty())
    warnings.push_back(source + ": the surface pointed inward and was turned outward: " +
                       count_text(inward.size(), "part") + of_all +
                       first_triangle(input, *inward.front()));
  if (!shells.empty())
    warnings.push_back(
        source + ": a closed part inside of another one is its cavity, although its " +
        "triangles face outward, and was turned: " + count_text(shells.size(), "part") + of_all +
        first_triangle(input, *shells.front()) +
        "; if it should be material, remove it: the outer part is solid without it");
}

}  // namespace bem
