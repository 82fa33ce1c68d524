#include "repair/soup.hpp"

#include "base/interruption.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/bounding_tree.hpp"
#include "mesh/closest_points.hpp"
#include "mesh/validate.hpp"
#include "mesh/weld.hpp"
#include "repair/disjoint_sets.hpp"

#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace bem {
namespace {

/// Joins those of the vertices `members` that are near each other.
std::size_t join_near(TriangleMesh& mesh, const std::vector<int>& members, double distance) {
  DisjointSets groups(mesh.vertices.size());
  std::size_t joined = 0;
  std::vector<BoundingBox> boxes;
  for (int v : members)
    boxes.push_back(widened({mesh.vertices[v], mesh.vertices[v]}, distance / 2));
  if (boxes.empty()) return 0;
  auto visit = [&](int i, int j) {
    const int v = members[i], w = members[j];
    if ((mesh.vertices[v] - mesh.vertices[w]).norm() <= distance) joined += groups.unite(v, w);
  };
  visit_self_overlaps(BoundingTree(boxes), 0, visit);
  if (joined == 0) return 0;
  for (Triangle& t : mesh.triangles)
    for (int& v : t) v = groups.find(v);
  return joined;
}

std::vector<int> rim_vertices(const TriangleMesh& mesh) {
  std::set<int> rim;
  for_each_edge(sorted_half_edges(mesh.triangles),
                [&](const HalfEdge* first, const HalfEdge* last) {
                  if (last - first == 1) rim.insert({first->low, first->high});
                });
  return {rim.begin(), rim.end()};
}

/// The edge across from the corner that lies on it, of a triangle without area.
std::pair<int, int> flat_edge(const TriangleMesh& mesh, const Triangle& t) {
  int longest = 0;
  double length = -1;
  for (int k = 0; k < 3; ++k) {
    const double l = (mesh.vertices[t[(k + 1) % 3]] - mesh.vertices[t[k]]).norm();
    if (l > length) longest = k, length = l;
  }
  return std::minmax(t[longest], t[(longest + 1) % 3]);
}

using Splits = std::map<std::pair<int, int>, int>;  ///< edge (low, high) -> vertex on it

void find_flat_triangles(const TriangleMesh& mesh, Splits& splits) {
  for (const Triangle& t : mesh.triangles) {
    if (height_ratio(mesh, t) >= kZeroHeightRatio) continue;
    const std::pair<int, int> edge = flat_edge(mesh, t);
    for (int v : t)
      if (v != edge.first && v != edge.second) splits[edge] = v;
  }
}

/// The vertex of the rim on the open edge, the nearest to its middle; -1 if there is none.
void find_vertices_on_open_edges(const TriangleMesh& mesh, double distance, Splits& splits) {
  std::vector<HalfEdge> open;
  for_each_edge(sorted_half_edges(mesh.triangles),
                [&](const HalfEdge* first, const HalfEdge* last) {
                  if (last - first == 1 && first->low != first->high) open.push_back(*first);
                });
  const std::vector<int> rim = rim_vertices(mesh);
  if (open.empty()) return;
  std::vector<BoundingBox> edges, points;
  for (const HalfEdge& e : open)
    edges.push_back(widened(bounding_box({mesh.vertices[e.low], mesh.vertices[e.high]}), distance));
  for (int v : rim) points.push_back({mesh.vertices[v], mesh.vertices[v]});
  auto visit = [&](int i, int j) {
    const HalfEdge& e = open[i];
    const Vec3 &p = mesh.vertices[rim[j]], &a = mesh.vertices[e.low], &b = mesh.vertices[e.high];
    if (rim[j] == e.low || rim[j] == e.high || (b - a).norm() <= 4 * distance) return;
    if ((p - a).norm() <= distance || (p - b).norm() <= distance) return;
    if (point_segment_distance(p, a, b) <= distance) splits.try_emplace({e.low, e.high}, rim[j]);
  };
  visit_overlaps(BoundingTree(edges), 0, BoundingTree(points), 0, visit);
}

/// Splits triangles at the first of their edges that has a vertex on it.
void split_triangles(TriangleMesh& mesh, const Splits& splits) {
  std::vector<Triangle> result;
  for (const Triangle& t : mesh.triangles) {
    bool done = false;
    for (int k = 0; k < 3 && !done; ++k) {
      const auto found = splits.find(std::minmax(t[k], t[(k + 1) % 3]));
      if (found == splits.end()) continue;
      const int v = found->second, opposite = t[(k + 2) % 3];
      done = true;
      if (v == opposite) continue;  // a triangle without area: gone
      result.push_back({t[k], v, opposite});
      result.push_back({v, t[(k + 1) % 3], opposite});
    }
    if (!done) result.push_back(t);
  }
  mesh.triangles = std::move(result);
}

/// Patches of triangles that edges of two triangles connect.
DisjointSets patches_of(const std::vector<Triangle>& triangles,
                        const std::vector<HalfEdge>& edges) {
  DisjointSets patches(triangles.size());
  for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) {
    if (last - first == 2) patches.unite(first[0].index / 3, first[1].index / 3);
  });
  return patches;
}

/// Drops patches of at most `part` of the area that end somewhere, and hang on others or do not.
std::size_t drop_open_patches(TriangleMesh& mesh, double part, bool hanging) {
  const std::vector<HalfEdge> edges = sorted_half_edges(mesh.triangles);
  DisjointSets patches = patches_of(mesh.triangles, edges);
  std::vector<char> ends(mesh.triangles.size(), 0), hangs(mesh.triangles.size(), 0);
  for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) {
    for (const HalfEdge* h = first; h != last; ++h) {
      const int patch = patches.find(h->index / 3);
      if (last - first == 1) ends[patch] = 1;
      if (last - first > 2) hangs[patch] = 1;
    }
  });
  std::vector<double> area(mesh.triangles.size(), 0);
  double total = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double a = triangle_area(mesh, mesh.triangles[t]);
    area[patches.find(static_cast<int>(t))] += a;
    total += a;
  }
  std::vector<Triangle> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const int patch = patches.find(static_cast<int>(t));
    const bool small = area[patch] <= part * total;
    if (!(ends[patch] && (hangs[patch] != 0) == hanging && small))
      kept.push_back(mesh.triangles[t]);
  }
  const std::size_t count = mesh.triangles.size() - kept.size();
  mesh.triangles = std::move(kept);
  return count;
}

}  // namespace

std::size_t weld_within(TriangleMesh& mesh, double distance) {
  mesh = weld(mesh).mesh;
  std::vector<int> all(mesh.vertices.size());
  std::iota(all.begin(), all.end(), 0);
  const std::size_t joined = join_near(mesh, all, distance);
  if (joined > 0) mesh = weld(mesh).mesh;
  return joined;
}

std::size_t weld_rims_within(TriangleMesh& mesh, double distance) {
  const std::size_t joined = join_near(mesh, rim_vertices(mesh), distance);
  if (joined > 0) mesh = weld(mesh).mesh;
  return joined;
}

std::size_t drop_collapsed(TriangleMesh& mesh) {
  std::vector<Triangle>& all = mesh.triangles;
  const auto end = std::remove_if(all.begin(), all.end(), [](const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
  const auto count = static_cast<std::size_t>(all.end() - end);
  all.erase(end, all.end());
  return count;
}

std::size_t split_edges_at_vertices(TriangleMesh& mesh, double distance) {
  constexpr int kPasses = 10;
  std::size_t count = 0;
  for (int pass = 0; pass < kPasses; ++pass) {
    check_interruption();
    Splits splits;
    find_flat_triangles(mesh, splits);
    find_vertices_on_open_edges(mesh, distance, splits);
    if (splits.empty()) break;
    count += splits.size();
    split_triangles(mesh, splits);
    drop_collapsed(mesh);
  }
  return count;
}

std::size_t drop_fins(TriangleMesh& mesh, double part) {
  return drop_open_patches(mesh, part, true);
}

std::size_t drop_loose_patches(TriangleMesh& mesh, double part) {
  return drop_open_patches(mesh, part, false);
}

BadEdges count_bad_edges(const TriangleMesh& mesh) {
  BadEdges bad;
  for_each_edge(sorted_half_edges(mesh.triangles),
                [&](const HalfEdge* first, const HalfEdge* last) {
                  if (last - first == 1) ++bad.open;
                  if (last - first > 2) ++bad.crowded;
                });
  return bad;
}

}  // namespace bem
