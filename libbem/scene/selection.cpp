#include "scene/selection.hpp"

#include "mesh/describe.hpp"
#include "scene/location.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bem {
namespace {

void check_indices(const Selection& s, std::size_t count, const char* what) {
  for (int i : s.indices)
    if (i < 0 || static_cast<std::size_t>(i) >= count)
      throw error_at(s.location, std::string(what) + " " + std::to_string(i) +
                                     " does not exist: the mesh has " + std::to_string(count) +
                                     " (0 to " + std::to_string(count - 1) + ")");
}

bool in_box(const Selection& s, const Vec3& p) {
  return (p.array() >= s.box_min.array()).all() && (p.array() <= s.box_max.array()).all();
}

/// Whether a box, a sphere or the side of a plane contains a point; their bounds included.
bool is_inside(const Selection& s, const Vec3& p) {
  switch (s.kind) {
    case Selection::Kind::box:
      return in_box(s, p);
    case Selection::Kind::sphere:
      return (p - s.point).norm() <= s.radius;
    case Selection::Kind::plane:
      return s.side.dot(p - s.point) >= 0;
    default:
      return false;
  }
}

/// Which nodes a selection of vertices or of a region chooses one by one.
std::vector<char> chosen_nodes(const BodyGeometry& g, const Selection& s) {
  if (s.kind == Selection::Kind::group)
    throw error_at(s.location, "there is no group " + in_quotes(s.group));
  std::vector<char> chosen(g.nodes.vertices.size(), s.kind == Selection::Kind::all);
  if (s.kind == Selection::Kind::vertices) {
    check_indices(s, g.input.vertices.size(), "vertex");
    for (int v : s.indices)
      if (g.node_of_vertex[v] >= 0) chosen[g.node_of_vertex[v]] = 1;
  } else {
    for (std::size_t v = 0; v < g.input.vertices.size(); ++v)
      if (g.node_of_vertex[v] >= 0 && is_inside(s, g.input.vertices[v]))
        chosen[g.node_of_vertex[v]] = 1;
  }
  return chosen;
}

std::vector<int> triangles_of(const BodyGeometry& g, const Selection& s) {
  std::vector<int> picked;
  if (s.kind == Selection::Kind::triangles) {
    check_indices(s, g.input.triangles.size(), "triangle");
    std::vector<int> position(g.triangle_order.size());
    for (std::size_t t = 0; t < position.size(); ++t)
      position[g.triangle_order[t]] = static_cast<int>(t);
    for (int t : s.indices) picked.push_back(position[t]);
    std::sort(picked.begin(), picked.end());
    picked.erase(std::unique(picked.begin(), picked.end()), picked.end());
    return picked;
  }
  const std::vector<char> chosen = chosen_nodes(g, s);
  for (std::size_t t = 0; t < g.nodes.triangles.size(); ++t) {
    const Triangle& tri = g.nodes.triangles[t];
    if (!chosen[tri[0]] || !chosen[tri[1]] || !chosen[tri[2]]) continue;
    if (s.normal) {
      const Vec3 n = triangle_normal(g.nodes, tri);
      const double angle = std::atan2(n.cross(*s.normal).norm(), n.dot(*s.normal));
      if (angle > s.normal_tolerance) continue;
    }
    picked.push_back(static_cast<int>(t));
  }
  return picked;
}

}  // namespace

std::vector<int> select_nodes(const BodyGeometry& g, const Selection& s) {
  std::vector<int> nodes;
  if (s.kind == Selection::Kind::triangles || s.normal) {
    for (int t : triangles_of(g, s))
      for (int v : g.nodes.triangles[t]) nodes.push_back(v);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  } else {
    const std::vector<char> chosen = chosen_nodes(g, s);
    for (std::size_t i = 0; i < chosen.size(); ++i)
      if (chosen[i]) nodes.push_back(static_cast<int>(i));
  }
  if (nodes.empty()) throw error_at(s.location, "the selection picks no vertex of the body's mesh");
  return nodes;
}

std::vector<int> select_triangles(const BodyGeometry& g, const Selection& s) {
  std::vector<int> triangles = triangles_of(g, s);
  if (triangles.empty())
    throw error_at(s.location,
                   "the selection picks no triangle of the body's mesh (a triangle needs "
                   "all three corners chosen)");
  return triangles;
}

const Selection* selection_by_numbers(const BodySpec& body) {
  const Selection* found = nullptr;
  for_each_selection(body, [&](const Selection& s) {
    if (s.kind == Selection::Kind::vertices || s.kind == Selection::Kind::triangles)
      if (!found) found = &s;
  });
  return found;
}

std::string to_text(const Selection& s) {
  std::string text = std::to_string(static_cast<int>(s.kind));
  for (int index : s.indices) text += " " + std::to_string(index);
  text += " " + to_text(s.box_min) + " " + to_text(s.box_max);
  text += " " + to_text(s.point) + " " + to_text(s.radius) + " " + to_text(s.side);
  if (s.normal) text += " " + to_text(*s.normal) + " " + to_text(s.normal_tolerance);
  return text;
}

}  // namespace bem
