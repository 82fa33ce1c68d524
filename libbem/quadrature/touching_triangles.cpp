#include "quadrature/touching_triangles.hpp"

#include "base/error.hpp"
#include "quadrature/gauss.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

constexpr int kFewest = 3, kMost = 10;  // Gauss points per direction
constexpr int kDeepestBox = 60;         // times that a box is halved
/// The error of n Gauss points relative to rho^-2n, for the kernels of elastostatics.
constexpr double kErrorScale = 10;

/// A point of the triangle 0 <= v <= u <= 1, whose corners are (0, 0), (1, 0) and (1, 1).
struct Place {
  double u, v;
};

/// Points on both triangles, and the Jacobian.
struct Places {
  Place x, y;
  double weight;
};

/// Those of (1, a, b, c) in the unit cube, in one of the regions: x or y does not depend on c, or
/// on b and c. Places of (t, a, b, c) are t times these, and the Jacobian is t^3 times that.
Places places(Adjacency adjacency, int region, const std::array<double, 3>& at) {
  const auto [a, b, c] = at;
  Places p = {};
  bool swap = false;
  if (adjacency == Adjacency::vertex) {
    p = {{1, a}, {b, b * c}, b};
    swap = region == 1;
  } else if (adjacency == Adjacency::edge) {
    switch (region) {
      case 0:
        p = {{1, a * b}, {1 - a * c, a * (1 - c)}, a * a};
        break;
      case 1:
        p = {{1, a}, {1 - a * b * c, a * b * (1 - c)}, a * a * b};
        break;
      case 2:
        p = {{1 - a * b, a * (1 - b)}, {1, a * b * c}, a * a * b};
        break;
      case 3:
        p = {{1 - a * b * c, a * b * (1 - c)}, {1, a}, a * a * b};
        break;
      default:
        p = {{1 - a * b * c, a * (1 - b * c)}, {1, a * b}, a * a * b};
    }
  } else {
    switch (region / 2) {
      case 0:
        p = {{1, 1 - a + a * b}, {1 - a * b * c, 1 - a}, a * a * b};
        break;
      case 1:
        p = {{1, a * (1 - b + b * c)}, {1 - a * b, a * (1 - b)}, a * a * b};
        break;
      default:
        p = {{1 - a * b * c, a * (1 - b * c)}, {1, a * (1 - b)}, a * a * b};
    }
    swap = region % 2 == 1;
  }
  if (swap) std::swap(p.x, p.y);
  return p;
}

int region_count(Adjacency adjacency) {
  return adjacency == Adjacency::vertex ? 2 : adjacency == Adjacency::edge ? 5 : 6;
}

void set(double scale, const Place& p, double* barycentric) {
  barycentric[0] = 1 - scale * p.u;
  barycentric[1] = scale * (p.u - p.v);
  barycentric[2] = scale * p.v;
}

const GaussRule& gauss(int n) {
  static const std::vector<GaussRule> rules = [] {
    std::vector<GaussRule> all(1);
    for (int i = 1; i <= 16; ++i) all.push_back(gauss_rule(i));
    return all;
  }();
  return rules.at(n);
}

/// A part of the cube of (a, b, c).
struct Box {
  std::array<double, 3> from = {0, 0, 0}, size = {1, 1, 1};
  int depth = 0;

  std::array<double, 3> at(const std::array<double, 3>& in) const {
    return {from[0] + size[0] * in[0], from[1] + size[1] * in[1], from[2] + size[2] * in[2]};
  }
  Box half(int direction, int index) const {
    Box h = *this;
    h.size[direction] /= 2;
    h.from[direction] += index * h.size[direction];
    ++h.depth;
    return h;
  }
};

/// Makes the rule of one pair.
class RuleMaker {
 public:
  RuleMaker(const TouchingTriangles& pair, const TouchingAccuracy& accuracy)
      : pair_(pair), accuracy_(accuracy), first_(static_cast<int>(pair.adjacency) - 1) {}

  using Counts = std::array<int, 3>;

  /// Calls use(region, box, numbers of points) for all parts that have a product rule each, while
  /// it returns true.
  template <class Use>
  void for_each_box(const Use& use) const {
    for (int region = 0; region < region_count(pair_.adjacency); ++region) {
      std::vector<Box> boxes = {Box()};
      while (!boxes.empty()) {
        const Box box = boxes.back();
        boxes.pop_back();
        const Counts counts = point_counts(region, box);
        const int most = static_cast<int>(std::max_element(counts.begin() + first_, counts.end()) -
                                          counts.begin());
        if (counts[most] > kMost && box.depth < kDeepestBox) {
          boxes.push_back(box.half(most, 1));
          boxes.push_back(box.half(most, 0));
        } else if (!use(region, box, counts)) {
          return;
        }
      }
    }
  }

  std::size_t size_of(const Counts& counts) const {
    std::size_t size = accuracy_.away;
    for (const int n : counts) size *= std::min(n, kMost);
    return size;
  }

  void add_points(int region, const Box& box, const Counts& counts,
                  std::vector<PairPoint>& points) const {
    constexpr double kProduct = 4;  // one over the product of the areas of two such triangles
    const GaussRule &away = gauss(accuracy_.away), &ga = gauss(std::min(counts[0], kMost)),
                    &gb = gauss(std::min(counts[1], kMost)),
                    &gc = gauss(std::min(counts[2], kMost));
    const double volume = box.size[0] * box.size[1] * box.size[2];
    for (std::size_t i = 0; i < away.nodes.size(); ++i) {
      const double t = away.nodes[i], scale = kProduct * away.weights[i] * volume * t * t * t;
      for (std::size_t a = 0; a < ga.nodes.size(); ++a)
        for (std::size_t b = 0; b < gb.nodes.size(); ++b)
          for (std::size_t c = 0; c < gc.nodes.size(); ++c) {
            const Places p =
                places(pair_.adjacency, region, box.at({ga.nodes[a], gb.nodes[b], gc.nodes[c]}));
            PairPoint& point = points.emplace_back();
            set(t, p.x, point.x);
            set(t, p.y, point.y);
            point.weight = scale * p.weight * ga.weights[a] * gb.weights[b] * gc.weights[c];
          }
    }
  }

 private:
  /// |x - y| over its scale, which is t about a vertex, t a about an edge, t a b in a triangle.
  Vec3 difference(int region, std::array<double, 3> at) const {
    for (int d = 0; d < first_; ++d) at[d] = 1;
    const Places p = places(pair_.adjacency, region, at);
    const std::array<Vec3, 3>&x = pair_.x, &y = pair_.y;
    return p.x.u * (x[1] - x[0]) + p.x.v * (x[2] - x[1]) - p.y.u * (y[1] - y[0]) -
           p.y.v * (y[2] - y[1]);
  }

  /// The numbers of Gauss points in a box. The difference v is linear in each direction, and the
  /// zeros of |v|^2 on a line lie on the ellipse about its ends e, f whose half axis, for a line of
  /// length 2, is (|v(e)| + |v(f)|)/|v(e) - v(f)|; the sum of its half axes is rho.
  Counts point_counts(int region, const Box& box) const {
    constexpr int kGrid = 3;
    Vec3 v[kGrid][kGrid][kGrid];
    double length[kGrid][kGrid][kGrid];
    const int na = first_ > 0 ? 1 : kGrid, nb = first_ > 1 ? 1 : kGrid;
    for (int i = 0; i < na; ++i)
      for (int j = 0; j < nb; ++j)
        for (int k = 0; k < kGrid; ++k) {
          v[i][j][k] = difference(region, box.at({0.5 * i, 0.5 * j, 0.5 * k}));
          length[i][j][k] = v[i][j][k].norm();
        }
    std::array<double, 3> least = {1e300, 1e300, 1e300};
    const auto see = [&](int direction, int i, int j, int k, int i2, int j2, int k2) {
      const double axis =
          (length[i][j][k] + length[i2][j2][k2]) / (v[i][j][k] - v[i2][j2][k2]).norm();
      least[direction] = std::min(least[direction], axis);
    };
    for (int i = 0; i < kGrid; ++i)
      for (int j = 0; j < kGrid; ++j) {
        if (i < na && j < nb) see(2, i, j, 0, i, j, 2);
        if (i < na && first_ < 2) see(1, i, 0, j, i, 2, j);
        if (first_ < 1) see(0, 0, i, j, 2, i, j);
      }
    Counts counts = {accuracy_.along, accuracy_.along, 0};
    for (int d = first_; d < 3; ++d) {
      const double axis = std::max(least[d], 1.0), rho = axis + std::sqrt(axis * axis - 1);
      const double n = std::log(kErrorScale / accuracy_.tolerance) / (2 * std::log(rho));
      counts[d] = n < kMost ? std::max(kFewest, static_cast<int>(std::ceil(n))) : kMost + 1;
    }
    return counts;
  }

  const TouchingTriangles& pair_;
  const TouchingAccuracy& accuracy_;
  int first_;  ///< direction of (a, b, c) in which |x - y| is not just a factor
};

}  // namespace

void touching_rule(const TouchingTriangles& pair, const TouchingAccuracy& accuracy,
                   std::vector<PairPoint>& points, const std::function<void()>& give) {
  constexpr std::size_t kTogether = 100000;
  require(pair.adjacency != Adjacency::none, "the triangles touch");
  const RuleMaker maker(pair, accuracy);
  points.clear();
  maker.for_each_box([&](int region, const Box& box, const RuleMaker::Counts& counts) {
    if (points.size() >= kTogether) {
      give();
      points.clear();
    }
    maker.add_points(region, box, counts, points);
    return true;
  });
  give();
}

std::size_t touching_rule_size(const TouchingTriangles& pair, const TouchingAccuracy& accuracy,
                               std::size_t most) {
  const RuleMaker maker(pair, accuracy);
  std::size_t size = 0;
  maker.for_each_box([&](int, const Box&, const RuleMaker::Counts& counts) {
    size += maker.size_of(counts);
    return size <= most;
  });
  return size;
}

}  // namespace bem
