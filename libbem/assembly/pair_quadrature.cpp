#include "assembly/pair_quadrature.hpp"

#include "mesh/closest_points.hpp"
#include "mesh/local_thickness.hpp"
#include "quadrature/triangle_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace bem {
namespace {

constexpr int kDeepestPair = 24;                  // times that triangles of a pair are halved
constexpr int kStaticAway = 3, kDynamicAway = 4;  // exact for static kernels, for 1/r in Z
constexpr int kStaticAlong = 2, kDynamicAlong = 3;
constexpr double kPerWave = 0.4, kMostForWaves = 4;  // more of them per |s| h/c2
constexpr double kDynamicPart = 0.05;                // of the square root of the tolerance

// Where a body is thin, its inertia against being squeezed is the small difference between pairs of
// triangles on one side and pairs on opposite sides: errors of either must be smaller, or motions
// grow.
constexpr double kVeryThin = 0.1;      // below kThinBody
constexpr double kThinnest = 0.01;     // that more exact rules are made for
constexpr double kWavesWhereThin = 2;  // up to so many times the wave number

std::vector<PairPoint> product_rule(const TriangleRule& x, const TriangleRule& y) {
  std::vector<PairPoint> out;
  for (int i = 0; i < x.size; ++i)
    for (int j = 0; j < y.size; ++j) {
      PairPoint p;
      p.weight = x.points[i].weight * y.points[j].weight;
      std::copy_n(x.points[i].barycentric, 3, p.x);
      std::copy_n(y.points[j].barycentric, 3, p.y);
      out.push_back(p);
    }
  return out;
}

/// Whether there is a rule, and it is of degree 2 at most.
bool is_midpoint_rule(int rule) {
  return rule >= 0 && triangle_rules()[rule].degree <= 2;
}

}  // namespace

PairQuadrature::PairQuadrature(const TriangleMesh& mesh, double tolerance, double wave_number)
    : mesh_(mesh),
      static_choice_(1000 * tolerance),
      dynamic_choice_(3000 * tolerance),
      tolerance_(tolerance),
      wave_number_(wave_number) {
  const std::vector<double> thickness = local_thickness(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    const auto places = corners(static_cast<int>(t));
    const TriangleCell cell(places);
    Panel p{triangle_normal(mesh, triangle),
            (places[0] + places[1] + places[2]) / 3,
            triangle_area(mesh, triangle),
            cell.longest_edge(),
            0,
            thickness[t]};
    for (const Vec3& x : places) p.radius = std::max(p.radius, (x - p.centre).norm());
    longest_edge_ = std::max(longest_edge_, p.longest_edge);
    panels_.push_back(p);
  }
  for (int x = 0; x < kTriangleRuleCount; ++x)
    for (int y = 0; y < kTriangleRuleCount; ++y)
      products_[x][y] = product_rule(triangle_rules()[x], triangle_rules()[y]);
}

bool PairQuadrature::midpoints_suffice(double distance, double longest_edge,
                                       KernelPart part) const {
  return is_midpoint_rule(rule_at(distance, longest_edge, part, wave_number_));
}

/// Up to which waves are resolved between two triangles that are not far from each other [1/m].
double PairQuadrature::wave_number(int tx, int ty) const {
  return (thickness(tx, ty) < kThinBody ? kWavesWhereThin : 1) * wave_number_;
}

/// For triangles that touch. Leading terms of Z times shape functions are polynomials away from
/// what they share, smaller errors and shorter waves ask for further ones.
TouchingAccuracy PairQuadrature::dynamic_accuracy(int tx, int ty) const {
  const double thin = thickness(tx, ty);
  const double more = std::max(0.0, std::ceil(-0.5 * std::log10(tolerance_) - 3)),
               waves = std::min(kMostForWaves, kPerWave * longest_edge_ * wave_number(tx, ty));
  TouchingAccuracy out{kDynamicAway + static_cast<int>(more + std::floor(waves)),
                       kDynamicAlong + static_cast<int>(more + std::ceil(waves)),
                       kDynamicPart * std::sqrt(tolerance_)};
  if (thin >= kThinBody) return out;
  out.away += thin < kVeryThin ? 2 : 1;
  out.tolerance *= std::max(thin, kThinnest) / kThinBody;
  return out;
}

Adjacency PairQuadrature::adjacency(int tx, int ty) const {
  int shared = 0;
  for (int a : mesh_.triangles[tx])
    for (int b : mesh_.triangles[ty]) shared += a == b;
  return static_cast<Adjacency>(shared);
}

/// Corners that the triangles share come first; which ones these are is set in `part`.
TouchingTriangles PairQuadrature::touching_pair(int tx, int ty, Part& part) const {
  const Triangle &a = mesh_.triangles[tx], &b = mesh_.triangles[ty];
  int shared = 0, rest_x = 3, rest_y = 3;
  for (int i = 0; i < 3; ++i) {
    const auto at = std::find(b.begin(), b.end(), a[i]);
    if (at == b.end()) {
      part.corner_x[--rest_x] = i;
    } else {
      part.corner_x[shared] = i;
      part.corner_y[shared++] = static_cast<int>(at - b.begin());
    }
  }
  for (int j = 0; j < 3; ++j)
    if (std::find(a.begin(), a.end(), b[j]) == a.end()) part.corner_y[--rest_y] = j;
  TouchingTriangles pair;
  pair.adjacency = static_cast<Adjacency>(shared);
  for (int k = 0; k < 3; ++k) {
    pair.x[k] = part.x.corners()[part.corner_x[k]];
    pair.y[k] = part.y.corners()[part.corner_y[k]];
  }
  return pair;
}

TouchingAccuracy PairQuadrature::touching_accuracy(int tx, int ty, KernelPart kernel) const {
  if (kernel == KernelPart::dynamic_part) return dynamic_accuracy(tx, ty);
  return {kStaticAway, kStaticAlong, tolerance_};
}

std::array<Vec3, 3> PairQuadrature::corners(int triangle) const {
  return triangle_corners(mesh_, mesh_.triangles[triangle]);
}

/// The rules of a pair that does not touch. Far from each other a lower bound of the distance is
/// enough to know them.
std::optional<std::array<int, 2>> PairQuadrature::unsplit_rules(int tx, int ty,
                                                                KernelPart part) const {
  constexpr double kFar = 3;  // of the longest edge
  const Panel &x = panels_[tx], &y = panels_[ty];
  double distance = (x.centre - y.centre).norm() - x.radius - y.radius;
  if (distance < kFar * std::max(x.longest_edge, y.longest_edge)) {
    distance = triangle_distance(corners(tx), corners(ty));
  }
  const double waves = wave_number(tx, ty);
  const int rule_x = rule_at(distance, x.longest_edge, part, waves),
            rule_y = rule_at(distance, y.longest_edge, part, waves);
  if (rule_x < 0 || rule_y < 0) return std::nullopt;
  return std::array<int, 2>{rule_x, rule_y};
}

void PairQuadrature::for_each_part(int tx, int ty, KernelPart kernel,
                                   const std::function<void(const Part&)>& f) const {
  const bool swapped = tx > ty;
  if (swapped) std::swap(tx, ty);
  const auto give = [&](Part part) {
    if (swapped) {
      std::swap(part.x, part.y);
      std::swap(part.rule_x, part.rule_y);
      part.swapped = true;
    }
    f(part);
  };
  if (adjacency(tx, ty) != Adjacency::none) {
    thread_local std::vector<PairPoint> points;  // f does not come back here
    Part part{TriangleCell(corners(tx)), TriangleCell(corners(ty))};
    const TouchingTriangles pair = touching_pair(tx, ty, part);
    part.touching = &points;
    touching_rule(pair, touching_accuracy(tx, ty, kernel), points, [&] { give(part); });
    return;
  }
  const Pair whole{TriangleCell(corners(tx)), TriangleCell(corners(ty))};
  if (const auto rules = unsplit_rules(tx, ty, kernel)) {
    give({whole.x, whole.y, (*rules)[0], (*rules)[1]});
    return;
  }
  const double waves = wave_number(tx, ty);
  std::vector<Pair> stack = {whole};
  while (!stack.empty()) {
    const Pair pair = stack.back();
    stack.pop_back();
    const double distance = triangle_distance(pair.x.corners(), pair.y.corners());
    const auto rule_of = [&](const TriangleCell& cell) {
      const int rule = rule_at(distance, cell.longest_edge(), kernel, waves);
      return rule < 0 && pair.depth >= kDeepestPair ? kTriangleRuleCount - 1 : rule;
    };
    const int rule_x = rule_of(pair.x), rule_y = rule_of(pair.y);
    if (rule_x >= 0 && rule_y >= 0) {
      give({pair.x, pair.y, rule_x, rule_y});
      continue;
    }
    const bool x_is_larger = pair.x.longest_edge() >= pair.y.longest_edge();
    const bool split_x = rule_y >= 0 || (rule_x < 0 && x_is_larger);
    for (int i = 0; i < 2; ++i)
      stack.push_back(
          {split_x ? pair.x.half(i) : pair.x, split_x ? pair.y : pair.y.half(i), pair.depth + 1});
  }
}

std::size_t PairQuadrature::near_point_count(int tx, int ty, KernelPart kernel,
                                             std::size_t most) const {
  if (tx > ty) std::swap(tx, ty);
  if (adjacency(tx, ty) != Adjacency::none) {
    Part part{TriangleCell(corners(tx)), TriangleCell(corners(ty))};
    return touching_rule_size(touching_pair(tx, ty, part), touching_accuracy(tx, ty, kernel), most);
  }
  struct Enough {};
  std::size_t count = 0;
  try {
    for_each_part(tx, ty, kernel, [&](const Part& part) {
      if (part.is_whole() && is_midpoint_rule(part.rule_x) && is_midpoint_rule(part.rule_y)) return;
      count += products_[part.rule_x][part.rule_y].size();
      if (count > most) throw Enough();
    });
  } catch (const Enough&) {  // parts may be as many as points
  }
  return count;
}

}  // namespace bem
