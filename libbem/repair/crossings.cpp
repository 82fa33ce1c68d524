#include "repair/crossings.hpp"

#include "mesh/bounding_tree.hpp"
#include "mesh/self_intersection.hpp"
#include "repair/holes.hpp"
#include "repair/orient_patches.hpp"

#include <limits>

namespace bem {
namespace {

std::vector<char> crossing_triangles(const TriangleMesh& mesh) {
  std::vector<char> crossing(mesh.triangles.size(), 0);
  auto visit = [&](int s, int t) {
    const Triangle &a = mesh.triangles[s], &b = mesh.triangles[t];
    if (std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end()) return;
    if (triangles_cross(triangle_corners(mesh, a), triangle_corners(mesh, b)))
      crossing[s] = crossing[t] = 1;
  };
  visit_self_overlaps(BoundingTree(mesh.triangles, mesh.vertices), 0, visit);
  return crossing;
}

/// Adds the triangles that have a vertex with a marked one in common.
void widen(const TriangleMesh& mesh, std::vector<char>& marked) {
  std::vector<char> vertices(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < marked.size(); ++t)
    if (marked[t])
      for (int v : mesh.triangles[t]) vertices[v] = 1;
  for (std::size_t t = 0; t < marked.size(); ++t)
    for (int v : mesh.triangles[t]) marked[t] |= vertices[v];
}

}  // namespace

std::optional<TriangleMesh> cut_out(const TriangleMesh& mesh, int rings) {
  std::vector<char> marked = crossing_triangles(mesh);
  for (int i = 0; i < rings; ++i) widen(mesh, marked);
  TriangleMesh rest{mesh.vertices, {}};
  for (std::size_t t = 0; t < marked.size(); ++t)
    if (!marked[t]) rest.triangles.push_back(mesh.triangles[t]);
  if (2 * rest.triangles.size() < mesh.triangles.size()) return std::nullopt;
  orient_patches(rest);
  std::optional<FilledHoles> filled = fill_holes(rest, std::numeric_limits<double>::infinity());
  if (!filled || !filled->left.empty()) return std::nullopt;
  return std::move(filled->mesh);
}

}  // namespace bem
