#include "mesh/two_sided.hpp"

#include "mesh/adjacency.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

/// A side of a triangle at one of its edges.
struct SideAtEdge {
  int side;  ///< 2 t: the triangle as it is, 2 t + 1: turned over
  int edge;  ///< from corner `edge` to the next one of that side

  int half_edge() const { return 3 * side + edge; }
};

/// The sides of the triangle of a half-edge of the set, at its edge.
SideAtEdge front(const HalfEdge& h) {
  return {2 * (h.index / 3), h.index % 3};
}

SideAtEdge back(const HalfEdge& h) {
  return {2 * (h.index / 3) + 1, 2 - h.index % 3};  // corners (a, c, b)
}

class Layers {
 public:
  explicit Layers(const TriangleMesh& mesh) : mesh_(mesh) {
    for (const auto& [a, b, c] : mesh.triangles) {
      add_side({a, b, c});
      add_side({a, c, b});
    }
  }

  TwoSided make() {
    const std::vector<HalfEdge> half_edges = sorted_half_edges(mesh_.triangles);
    for_each_edge(half_edges,
                  [&](const HalfEdge* first, const HalfEdge* last) { link_wedges(first, last); });
    number_corners();
    separate_crowded_edges();
    std::vector<Triangle>& all = out_.layers.triangles;
    out_.rim.assign(all.begin() + static_cast<std::ptrdiff_t>(layer_sides()), all.end());
    all.resize(layer_sides());
    add_offsets();
    return std::move(out_);
  }

 private:
  std::size_t layer_sides() const { return 2 * mesh_.triangles.size(); }

  int add_side(const Triangle& corners) {
    sides_.push_back(corners);
    for (int k = 0; k < 3; ++k) {
      twins_.push_back(-1);
      parent_.push_back(static_cast<int>(parent_.size()));
    }
    return static_cast<int>(sides_.size()) - 1;
  }

  /// Two triangles between the two sides of the only triangle at an edge.
  void close_rim(const HalfEdge& h) {
    const int a = sides_[front(h).side][front(h).edge];
    const int b = sides_[front(h).side][(front(h).edge + 1) % 3];
    const int first = add_side({b, a, a}), second = add_side({b, a, b});
    link({first, 0}, front(h));
    link({second, 1}, back(h));
    link({first, 2}, {second, 0});
  }

  /// Angle of the triangle about its edge, in the plane across the edge.
  double angle_about(const HalfEdge& h, const Vec3& axis, const Vec3& x, const Vec3& y) const {
    const int tip = mesh_.triangles[h.index / 3][(h.index % 3 + 2) % 3];
    const Vec3 d = mesh_.vertices[tip] - mesh_.vertices[h.low];
    const Vec3 across = d - axis.dot(d) * axis;
    return std::atan2(across.dot(y), across.dot(x));
  }

  /// Makes neighbours of the sides that look at each other around an edge.
  void link_wedges(const HalfEdge* first, const HalfEdge* last) {
    if (last - first == 1) return close_rim(*first);
    const Vec3 axis = (mesh_.vertices[first->high] - mesh_.vertices[first->low]).normalized();
    const Vec3 x = axis.unitOrthogonal(), y = axis.cross(x);
    std::vector<std::pair<double, const HalfEdge*>> around;
    for (const HalfEdge* h = first; h != last; ++h)
      around.emplace_back(angle_about(*h, axis, x, y), h);
    std::sort(around.begin(), around.end(), [](const auto& p, const auto& q) {
      return std::make_pair(p.first, p.second->index) < std::make_pair(q.first, q.second->index);
    });
    for (std::size_t i = 0; i < around.size(); ++i) {
      const HalfEdge& here = *around[i].second;
      const HalfEdge& next = *around[(i + 1) % around.size()].second;
      // A triangle that runs along its edge upwards looks counter-clockwise.
      link(here.forward ? front(here) : back(here), next.forward ? back(next) : front(next));
    }
  }

  void link(const SideAtEdge& a, const SideAtEdge& b) {
    twins_[a.half_edge()] = b.half_edge();
    twins_[b.half_edge()] = a.half_edge();
    // they run in opposite directions
    unite(3 * a.side + a.edge, 3 * b.side + (b.edge + 1) % 3);
    unite(3 * a.side + (a.edge + 1) % 3, 3 * b.side + b.edge);
  }

  int find(int corner) {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }

  void unite(int a, int b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  int new_vertex(int original) {
    out_.layers.vertices.push_back(mesh_.vertices[original]);
    return static_cast<int>(out_.layers.vertices.size()) - 1;
  }

  /// Corners that neighbours share are one vertex.
  void number_corners() {
    std::vector<int> number(parent_.size(), -1);
    for (std::size_t s = 0; s < sides_.size(); ++s) {
      Triangle t;
      for (int k = 0; k < 3; ++k) {
        int& n = number[find(static_cast<int>(3 * s) + k)];
        if (n < 0) n = new_vertex(sides_[s][k]);
        t[k] = n;
      }
      out_.layers.triangles.push_back(t);
    }
  }

  /// Where neighbours around both ends of an edge have joined several of its wedges, all wedges but
  /// the first get an end of their own.
  void separate_crowded_edges() {
    const std::vector<HalfEdge> half_edges = sorted_half_edges(out_.layers.triangles);
    for_each_edge(half_edges, [&](const HalfEdge* first, const HalfEdge* last) {
      const auto count = last - first;
      const int twin = twins_[first->index];
      if (count == 1 || (count == 2 && twin == first[1].index)) return;
      const bool ends_of_rim = count == 2 && twin < 0 && twins_[first[1].index] < 0;
      if (ends_of_rim && first[0].forward != first[1].forward) return;
      for (const HalfEdge* h = first; h != last; ++h) {
        const int other = twins_[h->index];
        if (h == first || other == first->index || (other >= 0 && other < h->index)) continue;
        const int own = new_vertex(sides_[h->index / 3][h->index % 3]);
        out_.layers.triangles[h->index / 3][h->index % 3] = own;
        if (other >= 0) out_.layers.triangles[other / 3][(other + 1) % 3] = own;
      }
    });
  }

  void add_offsets() {
    constexpr double kMostMiter = 3;
    const TriangleMesh& layers = out_.layers;
    std::vector<Vec3> sums(layers.vertices.size(), Vec3::Zero());
    std::vector<double> least(layers.vertices.size(), 1);
    const auto for_each_corner = [&](const auto& visit) {
      for (const Triangle& t : layers.triangles)
        for (int k = 0; k < 3; ++k) visit(t, k, triangle_normal(layers, t));
    };
    for_each_corner([&](const Triangle& t, int k, const Vec3& normal) {
      const Vec3 p = layers.vertices[t[(k + 1) % 3]] - layers.vertices[t[k]];
      const Vec3 q = layers.vertices[t[(k + 2) % 3]] - layers.vertices[t[k]];
      sums[t[k]] += std::atan2(p.cross(q).norm(), p.dot(q)) * normal;
    });
    for (Vec3& sum : sums) sum.normalize();
    for_each_corner([&](const Triangle& t, int k, const Vec3& normal) {
      least[t[k]] = std::min(least[t[k]], sums[t[k]].dot(normal));
    });
    for (std::size_t v = 0; v < sums.size(); ++v)
      out_.offsets.emplace_back(sums[v] / std::max(least[v], 1 / kMostMiter));
  }

  const TriangleMesh& mesh_;
  std::vector<Triangle> sides_;  ///< with the vertices of the set; those of the rim come last
  std::vector<int> twins_;       ///< by half-edge of the sides; -1: none
  std::vector<int> parent_;      ///< by corner of the sides: union-find
  TwoSided out_;
};

}  // namespace

TwoSided make_two_sided(const TriangleMesh& mesh) {
  return Layers(mesh).make();
}

}  // namespace bem
