#include "collision/surface_overlap.hpp"

#include "collision/moving_surface.hpp"
#include "collision/penetration.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <Eigen/Geometry>

namespace bem {
namespace {

/// Where the segment from p to q goes through the triangle, as a part of the way; nothing if it
/// does not, or runs along it.
std::optional<double> piercing(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double from = normal.dot(p - t[0]), to = normal.dot(q - t[0]);
  if ((from > 0) == (to > 0) || from == to) return std::nullopt;
  const double s = from / (from - to);
  const Vec3 x = p + s * (q - p);
  for (int k = 0; k < 3; ++k)
    if ((t[(k + 1) % 3] - t[k]).cross(x - t[k]).dot(normal) < 0) return std::nullopt;
  return s;
}

/// Points of surface a that may be deep in solid b: in the middle between the places where an edge
/// of a goes through b, and of the places where a triangle of a is cut.
class CutPoints {
 public:
  CutPoints(const SignedDistance& a, const SignedDistance& b) : a_(a), b_(b) {
    auto visit = [&](int s, int t) { cut(s, t); };
    if (!a.topology().triangles.empty() && !b.topology().triangles.empty())
      visit_overlaps(a.tree(), 0, b.tree(), 0, visit);
  }

  std::vector<Vec3> points() {
    std::vector<Vec3> out;
    for (auto& [edge, places] : on_edges_) {
      const auto& ends = a_.topology().edges[edge].vertices;
      const Vec3 p = a_.vertices()[ends[0]], q = a_.vertices()[ends[1]];
      places.insert(places.end(), {0.0, 1.0});
      std::sort(places.begin(), places.end());
      for (std::size_t i = 1; i < places.size(); ++i)
        out.emplace_back(p + 0.5 * (places[i - 1] + places[i]) * (q - p));
    }
    for (const auto& [triangle, sum] : in_triangles_) out.emplace_back(sum.first / sum.second);
    return out;
  }

 private:
  void cut(int s, int t) {
    const std::array<Vec3, 3> p = corners(a_, s), q = corners(b_, t);
    for (int k = 0; k < 3; ++k) {
      if (const auto place = piercing(p[k], p[(k + 1) % 3], q)) {
        const int edge = a_.topology().triangle_edges[s][k];
        const bool forward = a_.topology().edges[edge].vertices[0] == a_.topology().triangles[s][k];
        on_edges_[edge].push_back(forward ? *place : 1 - *place);
        add(s, p[k] + *place * (p[(k + 1) % 3] - p[k]));
      }
      if (const auto place = piercing(q[k], q[(k + 1) % 3], p))
        add(s, q[k] + *place * (q[(k + 1) % 3] - q[k]));
    }
  }

  static std::array<Vec3, 3> corners(const SignedDistance& x, int t) {
    const Triangle& c = x.topology().triangles[t];
    return {x.vertices()[c[0]], x.vertices()[c[1]], x.vertices()[c[2]]};
  }

  void add(int triangle, const Vec3& point) {
    auto& [sum, count] = in_triangles_.try_emplace(triangle, Vec3::Zero(), 0).first->second;
    sum += point;
    ++count;
  }

  const SignedDistance& a_;
  const SignedDistance& b_;
  std::map<int, std::vector<double>> on_edges_;
  std::map<int, std::pair<Vec3, int>>
      in_triangles_;  ///< sum and number of the places in a triangle
};

double depth_of_surface(const SignedDistance& a, const SignedDistance& b) {
  if (!b.closed()) return 0;
  return std::max(deepest_penetration(a.vertices(), b).depth,
                  deepest_penetration(CutPoints(a, b).points(), b).depth);
}

/// Diameter of the largest ball found in both solids, along the normals of triangles of a that
/// touch b: finds what coincides, where no point of a surface is inside the other.
double common_ball(const SignedDistance& a, const SignedDistance& b, double tolerance) {
  constexpr int kHalvings = 10;  // of the size, down to the least depth
  if (!a.closed() || !b.closed()) return 0;
  const double size = a.tree().nodes()[0].box.diagonal();
  const double least = std::max(std::ldexp(size, -kHalvings), 4 * tolerance);
  double largest = 0;
  for (const Triangle& t : a.topology().triangles) {
    const Vec3 p = a.vertices()[t[0]], q = a.vertices()[t[1]], r = a.vertices()[t[2]];
    const Vec3 centre = (p + q + r) / 3, inward = -unit_normal(p, q, r);
    const auto radius = [&](double depth) {
      const Vec3 x = centre + depth * inward;
      return std::min(-a(x), -b(x));
    };
    // the centre may lie in a side of the box
    const bool in_box = overlap(b.tree().nodes()[0].box, widened({centre, centre}, tolerance));
    if (!in_box || std::abs(b(centre)) > tolerance || radius(least) <= tolerance) continue;
    for (double depth = least; depth < size; depth *= 2) {
      const Vec3 x = centre + depth * inward;
      if (2 * radius(depth) > largest && a.surely_contains(x) && b.surely_contains(x))
        largest = 2 * radius(depth);
    }
  }
  return largest;
}

}  // namespace

double surface_overlap(const SignedDistance& a, const SignedDistance& b, double tolerance) {
  if (a.tree().nodes().empty() || b.tree().nodes().empty() ||
      !overlap(a.tree().nodes()[0].box, b.tree().nodes()[0].box))
    return 0;
  double depth = std::max(depth_of_surface(a, b), depth_of_surface(b, a));
  if (depth <= tolerance)
    depth = std::max(common_ball(a, b, tolerance), common_ball(b, a, tolerance));
  return depth > tolerance ? depth : 0;
}

}  // namespace bem
