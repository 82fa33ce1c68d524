#include "mesh/validate.hpp"

#include "base/error.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/describe.hpp"
#include "mesh/open_edges.hpp"

#include <algorithm>
#include <limits>

namespace bem {
namespace {

/// The first of the bad elements and their number.
struct Found {
  std::size_t count = 0;
  int first = std::numeric_limits<int>::max();

  void add(int element) {
    ++count;
    first = std::min(first, element);
  }
};

[[noreturn]] void refuse(const std::string& source, const std::string& what,
                         const std::string& total, const std::string& cure) {
  throw Error(ErrorCode::invalid_input,
              source + ": " + what + " (counting from 0); " + total + " in all; " + cure);
}

/// "edge 3-7 of triangle 5 (vertices 1, 7, 3)" for half-edge 3 t + k, with the input's vertices.
std::string edge_text(const TriangleMesh& input, int half_edge) {
  const int t = half_edge / 3;
  const int from = input.triangles[t][half_edge % 3];
  const int to = input.triangles[t][(half_edge + 1) % 3];
  return "edge " + std::to_string(from) + "-" + std::to_string(to) + " of " +
         triangle_text(input, t);
}

void check_areas(const TriangleMesh& input, const TriangleMesh& nodes, const std::string& source) {
  Found bad;
  for (std::size_t t = 0; t < nodes.triangles.size(); ++t)
    if (!(height_ratio(nodes, nodes.triangles[t]) >= kZeroHeightRatio))
      bad.add(static_cast<int>(t));
  if (bad.count == 0) return;
  const Triangle& corners = input.triangles[bad.first];
  refuse(source,
         "zero-area triangle: " + triangle_text(input, bad.first) + " at " +
             to_text(input.vertices[corners[0]]) + ", " + to_text(input.vertices[corners[1]]) +
             ", " + to_text(input.vertices[corners[2]]) + " is lower than " +
             to_text(kZeroHeightRatio) + " of its longest edge",
         count_text(bad.count, "such triangle"), "collapse or remove them");
}

/// Open edges are holes, or edges that lie on each other without sharing their vertices.
[[noreturn]] void refuse_open(const TriangleMesh& input, const TriangleMesh& nodes,
                              const std::string& source) {
  const OpenEdges open = find_open_edges(nodes);
  const std::string total = count_text(open.edges.size(), "such edge");
  const auto matched =
      std::find_if(open.twin.begin(), open.twin.end(), [](int t) { return t >= 0; });
  if (matched != open.twin.end()) {
    const int edge = open.edges[matched - open.twin.begin()];
    const std::string distance = rounded_text(open.tolerance * (1 + 1e-2), 3);
    refuse(
        source,
        "edges that lie on each other without sharing their vertices: " + edge_text(input, edge) +
            " has no triangle on its other side, but " + edge_text(input, *matched) +
            " is in its place",
        count_text(open.matched, "such edge"),
        "join vertices up to " + distance + " m apart in the program that the mesh comes from: " +
            (open.remaining == 0 ? "that closes the surface"
                                 : "that leaves " + count_text(open.remaining, "open edge")));
  }
  const int edge = open.edges.front();
  const int vertex = vertex_on_edge(nodes, open, edge);
  const std::string what = "open boundary: " + edge_text(input, edge) + " has no triangle on its ";
  if (vertex >= 0)
    refuse(source,
           what + "other side, and the vertex at " + to_text(nodes.vertices[vertex]) +
               " lies on it between its ends",
           total, "split the edges there, so that triangles meet along whole edges");
  refuse(source, what + "other side", total, "close the holes of the surface");
}

void check_edges(const TriangleMesh& input, const TriangleMesh& nodes, const std::string& source) {
  Found open, crowded, turned;
  std::size_t crowd = 0;
  const std::vector<HalfEdge> half_edges = sorted_half_edges(nodes.triangles);
  for_each_edge(half_edges, [&](const HalfEdge* first, const HalfEdge* last) {
    if (last - first == 1) open.add(first->index);
    if (last - first == 2 && first[0].forward == first[1].forward) turned.add(first->index);
    if (last - first > 2) {
      if (first->index < crowded.first) crowd = static_cast<std::size_t>(last - first);
      crowded.add(first->index);
    }
  });
  if (crowded.count > 0)
    refuse(source,
           "non-manifold edge: " + edge_text(input, crowded.first) + " belongs to " +
               std::to_string(crowd) + " triangles instead of 2",
           count_text(crowded.count, "such edge"),
           "remove inner and repeated faces, or move touching parts a little apart");
  if (open.count > 0) refuse_open(input, nodes, source);
  if (turned.count > 0)
    refuse(source,
           "inconsistent orientation: the two triangles at " + edge_text(input, turned.first) +
               " face opposite sides",
           count_text(turned.count, "such edge"),
           "recompute the face orientation so that all triangles face outward");
}

/// The triangles around every vertex must form one cycle: walking around it from edge to edge has
/// to meet them all.
void check_fans(const TriangleMesh& input, const TriangleMesh& nodes, const std::string& source) {
  const std::vector<int> twins = half_edge_twins(nodes.triangles);
  std::vector<int> valence(nodes.vertices.size(), 0);
  std::vector<int> start(nodes.vertices.size(), -1);
  for (int h = static_cast<int>(twins.size()) - 1; h >= 0; --h) {
    const int v = nodes.triangles[h / 3][h % 3];
    ++valence[v];
    start[v] = h;
  }
  Found bad;
  for (std::size_t v = 0; v < valence.size(); ++v) {
    int reached = 0;
    int h = start[v];
    do {
      ++reached;
      const int twin = twins[h];  // ends at v; the next half-edge of its triangle starts at v
      h = twin - twin % 3 + (twin + 1) % 3;
    } while (h != start[v]);
    if (reached != valence[v]) bad.add(start[v]);
  }
  if (bad.count == 0) return;
  const int vertex = input.triangles[bad.first / 3][bad.first % 3];
  refuse(source,
         "non-manifold vertex: " + vertex_text(input, vertex) +
             " joins parts of the surface that touch only there",
         count_text(bad.count, "such vertex"), "move the parts a little apart or merge them");
}

}  // namespace

void check_elements(const TriangleMesh& input, const std::string& source) {
  if (input.triangles.empty())
    throw Error(ErrorCode::invalid_input,
                source + ": no triangle at all: the mesh must be a closed triangle surface");
  require(input.vertices.size() + 3 * input.triangles.size() <
              static_cast<std::size_t>(std::numeric_limits<int>::max()),
          "mesh elements are counted by int");
  const int n = static_cast<int>(input.vertices.size());
  Found range, coordinate;
  for (std::size_t t = 0; t < input.triangles.size(); ++t) {
    const Triangle& c = input.triangles[t];
    if (std::any_of(c.begin(), c.end(), [&](int v) { return v < 0 || v >= n; }))
      range.add(static_cast<int>(t));
  }
  for (int v = 0; v < n; ++v)
    if (!input.vertices[v].allFinite()) coordinate.add(v);
  if (range.count > 0)
    refuse(source,
           "index out of range: " + triangle_text(input, range.first) + " but the mesh has " +
               count_text(input.vertices.size(), "vertex"),
           count_text(range.count, "such triangle"), "the file is damaged or incomplete");
  if (coordinate.count > 0)
    refuse(source, "non-finite coordinate: " + vertex_text(input, coordinate.first),
           count_text(coordinate.count, "such vertex"), "export the mesh again");
}

void check_closed_manifold(const TriangleMesh& input, const TriangleMesh& nodes,
                           const std::string& source) {
  check_areas(input, nodes, source);
  check_edges(input, nodes, source);
  check_fans(input, nodes, source);
}

void warn_thin_triangles(const TriangleMesh& input, const TriangleMesh& nodes,
                         const std::string& source, std::vector<std::string>& warnings) {
  Found thin;
  for (std::size_t t = 0; t < nodes.triangles.size(); ++t)
    if (height_ratio(nodes, nodes.triangles[t]) < kThinHeightRatio) thin.add(static_cast<int>(t));
  if (thin.count == 0) return;
  const double ratio = height_ratio(nodes, nodes.triangles[thin.first]);
  warnings.push_back(source + ": very thin triangles (height below " + to_text(kThinHeightRatio) +
                     " of the longest edge): " + count_text(thin.count, "triangle") + ", first " +
                     triangle_text(input, thin.first) + " with " + to_text(ratio) +
                     "; accuracy suffers near them, remesh if possible");
}

}  // namespace bem
