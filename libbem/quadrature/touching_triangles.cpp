#include "quadrature/touching_triangles.hpp"

#include "base/error.hpp"
#include "quadrature/gauss.hpp"

namespace bem {
namespace {

/// A point of the triangle 0 <= v <= u <= 1, whose corners are (0, 0), (1, 0) and (1, 1).
struct Place {
  double u, v;
};

void set(const Place& p, double* barycentric) {
  barycentric[0] = 1 - p.u;
  barycentric[1] = p.u - p.v;
  barycentric[2] = p.v;
}

/// Collects the points region by region.
class Collector {
 public:
  /// Starts with the regions of another quadrature point.
  void restart() { region_ = 0; }

  /// The point (x, y) of the next region, scaled towards the common corner.
  void add(double scale, Place x, Place y, double weight) {
    if (region_ == regions_.size()) regions_.emplace_back();
    PairPoint p;
    set({scale * x.u, scale * x.v}, p.x);
    set({scale * y.u, scale * y.v}, p.y);
    p.weight = weight;
    regions_[region_++].push_back(p);
  }
  void add_both(double scale, Place x, Place y, double weight) {
    add(scale, x, y, weight);
    add(scale, y, x, weight);
  }

  std::vector<PairPoint> points() const {
    std::vector<PairPoint> all;
    for (const auto& region : regions_) all.insert(all.end(), region.begin(), region.end());
    return all;
  }

 private:
  std::vector<std::vector<PairPoint>> regions_;
  std::size_t region_ = 0;
};

/// The points of all regions at (t, a, b, c) in the unit cube, of weight w: x or y does not depend
/// on c, or on b and c.
void add_regions(Adjacency adjacency, double t, double a, double b, double c, double w,
                 Collector& out) {
  constexpr double kProduct = 4;  // one over the product of the areas of two such triangles
  w *= kProduct * t * t * t;
  if (adjacency == Adjacency::vertex) {
    out.add_both(t, {1, a}, {b, b * c}, w * b);
  } else if (adjacency == Adjacency::edge) {
    w *= a * a;
    out.add(t, {1, a * b}, {1 - a * c, a * (1 - c)}, w);
    out.add(t, {1, a}, {1 - a * b * c, a * b * (1 - c)}, w * b);
    out.add(t, {1 - a * b, a * (1 - b)}, {1, a * b * c}, w * b);
    out.add(t, {1 - a * b * c, a * b * (1 - c)}, {1, a}, w * b);
    out.add(t, {1 - a * b * c, a * (1 - b * c)}, {1, a * b}, w * b);
  } else {
    w *= a * a * b;
    out.add_both(t, {1, 1 - a + a * b}, {1 - a * b * c, 1 - a}, w);
    out.add_both(t, {1, a * (1 - b + b * c)}, {1 - a * b, a * (1 - b)}, w);
    out.add_both(t, {1 - a * b * c, a * (1 - b * c)}, {1, a * (1 - b)}, w);
  }
}

}  // namespace

std::vector<PairPoint> touching_rule(Adjacency adjacency, int n, int radial) {
  require(adjacency != Adjacency::none, "the triangles touch");
  const GaussRule g = gauss_rule(n), away = gauss_rule(radial);
  Collector out;
  for (int i = 0; i < radial; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        for (int l = 0; l < n; ++l) {
          out.restart();
          add_regions(adjacency, away.nodes[i], g.nodes[j], g.nodes[k], g.nodes[l],
                      away.weights[i] * g.weights[j] * g.weights[k] * g.weights[l], out);
        }
  return out.points();
}

}  // namespace bem
