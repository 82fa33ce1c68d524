#include "mesh/open_edges.hpp"

#include "base/interruption.hpp"
#include "mesh/adjacency.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace bem {
namespace {

constexpr double kCoincidence = 1e-3;  ///< of an edge's length

class Seams {
 public:
  explicit Seams(const TriangleMesh& nodes) : nodes_(nodes) {}

  OpenEdges find() {
    for_each_edge(sorted_half_edges(nodes_.triangles),
                  [&](const HalfEdge* first, const HalfEdge* last) {
                    if (last - first == 1) open_.edges.push_back(first->index);
                  });
    std::sort(open_.edges.begin(), open_.edges.end());
    match();
    if (open_.matched > 0) open_.remaining = count_after_joining();
    return std::move(open_);
  }

 private:
  std::pair<int, int> ends(int half_edge) const {
    const Triangle& t = nodes_.triangles[half_edge / 3];
    return {t[half_edge % 3], t[(half_edge + 1) % 3]};
  }

  double distance(int v, int w) const { return (nodes_.vertices[v] - nodes_.vertices[w]).norm(); }

  double length(int half_edge) const {
    const auto [from, to] = ends(half_edge);
    return distance(from, to);
  }

  Vec3 middle(int half_edge) const {
    const auto [from, to] = ends(half_edge);
    return 0.5 * (nodes_.vertices[from] + nodes_.vertices[to]);
  }

  /// How far apart the ends of two edges are, in the better of both directions.
  double gap(int e, int f) const {
    const auto [a, b] = ends(e);
    const auto [c, d] = ends(f);
    return std::min(std::max(distance(a, d), distance(b, c)),
                    std::max(distance(a, c), distance(b, d)));
  }

  /// Numbers 0 .. n - 1 in the order of `points` along the longest side of their box, and the
  /// coordinates there, ascending.
  static std::vector<std::pair<double, int>> swept(const std::vector<Vec3>& points) {
    const BoundingBox box = bounding_box(points);
    int axis = 0;
    (box.max - box.min).maxCoeff(&axis);
    std::vector<std::pair<double, int>> order;
    for (const Vec3& p : points) order.emplace_back(p[axis], static_cast<int>(order.size()));
    std::sort(order.begin(), order.end());
    return order;
  }

  /// Calls visit(i, j) once for all i, j of `points` that may be nearer than reach(i).
  template <typename Reach, typename Visit>
  static void sweep(const std::vector<Vec3>& points, Reach reach, Visit visit) {
    const auto order = swept(points);
    for (std::size_t i = 0; i < order.size(); ++i) {
      check_interruption();
      const double end = order[i].first + reach(order[i].second);
      for (std::size_t j = i + 1; j < order.size() && order[j].first <= end; ++j)
        visit(order[i].second, order[j].second);
    }
  }

  void match() {
    const std::vector<int>& edges = open_.edges;
    open_.twin.assign(edges.size(), -1);
    std::vector<double> best(edges.size(), 0);
    std::vector<Vec3> middles;
    for (int e : edges) middles.push_back(middle(e));
    const auto take = [&](int i, int j, double found) {
      if (open_.twin[i] >= 0 && best[i] <= found) return;
      open_.twin[i] = edges[j];
      best[i] = found;
    };
    // middles are no farther apart than the ends
    sweep(
        middles, [&](int i) { return kCoincidence * length(edges[i]); },
        [&](int i, int j) {
          const double found = gap(edges[i], edges[j]);
          if (found > kCoincidence * std::min(length(edges[i]), length(edges[j]))) return;
          take(i, j, found);
          take(j, i, found);
        });
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (open_.twin[i] < 0) continue;
      ++open_.matched;
      open_.tolerance = std::max(open_.tolerance, best[i]);
    }
  }

  /// Open edges when vertices of open edges are joined up to the tolerance.
  std::size_t count_after_joining() const {
    std::vector<int> rim;
    for (int e : open_.edges) rim.push_back(ends(e).first), rim.push_back(ends(e).second);
    std::sort(rim.begin(), rim.end());
    rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
    std::vector<Vec3> points;
    for (int v : rim) points.push_back(nodes_.vertices[v]);
    std::vector<int> joined(nodes_.vertices.size());
    std::iota(joined.begin(), joined.end(), 0);
    const auto root = [&](int v) {
      while (joined[v] != v) v = joined[v] = joined[joined[v]];
      return v;
    };
    sweep(
        points, [&](int) { return open_.tolerance; },
        [&](int i, int j) {
          if (distance(rim[i], rim[j]) <= open_.tolerance) joined[root(rim[j])] = root(rim[i]);
        });
    std::vector<Triangle> triangles = nodes_.triangles;
    for (Triangle& t : triangles)
      for (int& v : t) v = root(v);
    std::size_t count = 0;
    for_each_edge(sorted_half_edges(triangles), [&](const HalfEdge* first, const HalfEdge* last) {
      if (last - first == 1 && first->low != first->high) ++count;
    });
    return count;
  }

  const TriangleMesh& nodes_;
  OpenEdges open_;
};

}  // namespace

OpenEdges find_open_edges(const TriangleMesh& nodes) {
  return Seams(nodes).find();
}

int vertex_on_edge(const TriangleMesh& nodes, const OpenEdges& open, int half_edge) {
  const Triangle& t = nodes.triangles[half_edge / 3];
  const Vec3& from = nodes.vertices[t[half_edge % 3]];
  const Vec3 along = nodes.vertices[t[(half_edge + 1) % 3]] - from;
  for (int e : open.edges) {
    const int v = nodes.triangles[e / 3][e % 3];
    const Vec3 arm = nodes.vertices[v] - from;
    const double place = arm.dot(along) / along.squaredNorm();
    if (place > kCoincidence && place < 1 - kCoincidence &&
        (arm - place * along).norm() <= 1e-6 * along.norm())
      return v;
  }
  return -1;
}

}  // namespace bem
