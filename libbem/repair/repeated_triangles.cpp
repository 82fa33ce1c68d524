#include "repair/repeated_triangles.hpp"

#include "mesh/adjacency.hpp"
#include "repair/soup.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace bem {
namespace {

std::array<int, 3> sorted_corners(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// Whether the corners are an even permutation of their sorted order.
bool looks_up(const Triangle& t) {
  return (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2;
}

/// The triangles without repetitions; opposite ones cancel or leave one.
std::vector<Triangle> without_repetitions(const TriangleMesh& mesh, bool cancel) {
  std::map<std::array<int, 3>, std::pair<int, int>> counts;  // that look up and down
  for (const Triangle& t : mesh.triangles) {
    auto& [up, down] = counts[sorted_corners(t)];
    ++(looks_up(t) ? up : down);
  }
  std::vector<Triangle> kept;
  std::set<std::array<int, 3>> seen;
  for (const Triangle& t : mesh.triangles) {
    const auto corners = sorted_corners(t);
    const auto [up, down] = counts[corners];
    if (cancel && up > 0 && down > 0) continue;
    if (seen.insert(corners).second) kept.push_back(t);
  }
  return kept;
}

/// Whether four points lie in a plane, up to rounding.
bool are_flat(const TriangleMesh& mesh, const std::array<int, 4>& corners) {
  const auto& p = mesh.vertices;
  const Vec3 a = p[corners[1]] - p[corners[0]], b = p[corners[2]] - p[corners[0]],
             c = p[corners[3]] - p[corners[0]];
  return std::abs(a.dot(b.cross(c))) <= 1e-6 * a.norm() * b.norm() * c.norm();
}

/// The four different corners of two triangles that share an edge, sorted; empty otherwise.
std::optional<std::array<int, 4>> quadrangle(const Triangle& s, const Triangle& t) {
  std::set<int> all(s.begin(), s.end());
  all.insert(t.begin(), t.end());
  if (all.size() != 4) return std::nullopt;
  std::array<int, 4> corners{};
  std::copy(all.begin(), all.end(), corners.begin());
  return corners;
}

int missing_corner(const std::array<int, 4>& corners, const Triangle& t) {
  return *std::find_if(corners.begin(), corners.end(),
                       [&](int v) { return std::find(t.begin(), t.end(), v) == t.end(); });
}

/// That of the triangles on four corners in a plane which makes the quadrangle with the first of
/// them; -1 if there is none.
int across_diagonal(const TriangleMesh& mesh, const std::array<int, 4>& corners,
                    const std::vector<int>& triangles) {
  const int own = missing_corner(corners, mesh.triangles[triangles.front()]);
  for (int t : triangles) {
    const int other = missing_corner(corners, mesh.triangles[t]);
    if (other == own) continue;
    std::vector<Vec3> diagonal;
    for (int v : corners)
      if (v != own && v != other) diagonal.push_back(mesh.vertices[v]);
    const Vec3 along = diagonal[1] - diagonal[0];
    const Vec3 side = along.cross(mesh.vertices[own] - diagonal[0]);
    if (side.dot(along.cross(mesh.vertices[other] - diagonal[0])) < 0) return t;
  }
  return -1;
}

}  // namespace

std::size_t drop_repeated(TriangleMesh& mesh) {
  const std::size_t before = mesh.triangles.size();
  TriangleMesh walls_gone{mesh.vertices, without_repetitions(mesh, true)};
  TriangleMesh walls_kept{mesh.vertices, without_repetitions(mesh, false)};
  if (walls_kept.triangles.size() == before) return 0;
  const bool gone = !walls_gone.triangles.empty() &&
                    count_bad_edges(walls_gone).total() < count_bad_edges(walls_kept).total();
  mesh = std::move(gone ? walls_gone : walls_kept);
  return before - mesh.triangles.size();
}

std::size_t drop_other_diagonals(TriangleMesh& mesh) {
  std::map<std::array<int, 4>, std::set<int>> quadrangles;  // and their triangles
  for_each_edge(
      sorted_half_edges(mesh.triangles), [&](const HalfEdge* first, const HalfEdge* last) {
        for (const HalfEdge* h = first; h != last; ++h)
          for (const HalfEdge* g = h + 1; g != last; ++g)
            if (const auto corners =
                    quadrangle(mesh.triangles[h->index / 3], mesh.triangles[g->index / 3]))
              quadrangles[*corners].insert({h->index / 3, g->index / 3});
      });
  std::vector<char> gone(mesh.triangles.size(), 0);
  for (const auto& [corners, triangles] : quadrangles) {
    if (triangles.size() != 4 || !are_flat(mesh, corners)) continue;
    const std::vector<int> all(triangles.begin(), triangles.end());
    const int partner = across_diagonal(mesh, corners, all);
    for (int t : all)
      if (partner >= 0 && t != all.front() && t != partner) gone[t] = 1;
  }
  std::vector<Triangle> rest;
  for (std::size_t t = 0; t < gone.size(); ++t)
    if (!gone[t]) rest.push_back(mesh.triangles[t]);
  const std::size_t count = mesh.triangles.size() - rest.size();
  mesh.triangles = std::move(rest);
  return count;
}

}  // namespace bem
