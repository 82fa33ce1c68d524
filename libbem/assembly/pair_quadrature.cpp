#include "assembly/pair_quadrature.hpp"

#include "assembly/panel_quadrature.hpp"
#include "quadrature/triangle_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace bem {
namespace {

constexpr int kDeepest = 24;  // times that triangles of a pair are halved
constexpr double kObtuse = 110 * kPi / 180;
constexpr int kMoreForObtuse = 3;  // Gauss points per direction
/// Longest edge over height: from here on static parts need more points, whose errors grow with it.
constexpr double kSlender = 4, kVerySlender = 8;
constexpr int kMoreForSlender = 4, kMoreForVerySlender = 6;
/// Cosines of the angle of the normals at a shared edge from which on it counts as sharp: for the
/// dynamic parts, whose kernels are not symmetric about it, and for the static ones.
constexpr double kFolded = 0.8, kSharp = -0.2;
constexpr int kDynamicForEdges = 4, kStaticForEdges = 4, kMostForWaves = 4;
constexpr int kStaticRadial = 3, kDynamicRadial = 4;  // exact for static kernels, for Z(0)

/// Gauss points per direction of touching pairs for an error relative to the largest entry.
int static_order(double tolerance) {
  return std::clamp(static_cast<int>(std::ceil(1 - std::log10(tolerance))), 4, 14);
}
int dynamic_order(double tolerance) {
  return std::clamp(static_cast<int>(std::ceil(1 - 0.5 * std::log10(tolerance))), 3, 12);
}

double segment_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm(), uw = u.dot(w),
               vw = v.dot(w);
  const double det = uu * vv - uv * uv;
  double s = det > 1e-12 * uu * vv ? std::clamp((uv * vw - vv * uw) / det, 0.0, 1.0) : 0.0;
  const double t = std::clamp((uv * s + vw) / vv, 0.0, 1.0);
  s = std::clamp((uv * t - uw) / uu, 0.0, 1.0);
  return (w + s * u - t * v).norm();
}

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

}  // namespace

double triangle_distance(const Vec3* a, const Vec3* b) {
  double distance = (a[0] - b[0]).norm();
  for (int i = 0; i < 3; ++i) {
    distance = std::min({distance, point_triangle_distance(a[i], b[0], b[1], b[2]),
                         point_triangle_distance(b[i], a[0], a[1], a[2])});
    for (int j = 0; j < 3; ++j)
      distance = std::min(distance, segment_distance(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
  }
  return distance;
}

PairQuadrature::PairQuadrature(const TriangleMesh& mesh, double tolerance, double wave_number)
    : mesh_(mesh),
      static_choice_(1000 * tolerance),
      dynamic_choice_(3000 * tolerance),
      wave_number_(wave_number),
      static_order_(static_order(tolerance)),
      dynamic_order_(dynamic_order(tolerance)) {
  for (const Triangle& t : mesh.triangles) {
    const Vec3 corners[3] = {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    Panel p{triangle_normal(mesh, t),
            (corners[0] + corners[1] + corners[2]) / 3,
            triangle_area(mesh, t),
            longest_edge(mesh, t),
            0,
            0};
    for (const Vec3& x : corners) p.radius = std::max(p.radius, (x - p.centre).norm());
    for (int k = 0; k < 3; ++k) {
      const Vec3 u = (mesh.vertices[t[(k + 1) % 3]] - mesh.vertices[t[k]]).normalized();
      const Vec3 v = (mesh.vertices[t[(k + 2) % 3]] - mesh.vertices[t[k]]).normalized();
      p.widest_angle = std::max(p.widest_angle, std::acos(std::clamp(u.dot(v), -1.0, 1.0)));
    }
    panels_.push_back(p);
  }
  for (int x = 0; x < kTriangleRuleCount; ++x)
    for (int y = 0; y < kTriangleRuleCount; ++y)
      products_[x][y] = product_rule(triangle_rules()[x], triangle_rules()[y]);
  make_touching_rules();
}

/// Those that pairs of this mesh need.
void PairQuadrature::make_touching_rules() {
  const int radial =
      kDynamicRadial + std::min(kMostForWaves, static_cast<int>(0.4 * longest_wave()));
  const auto need = [&](int tx, int ty, Adjacency adjacency) {
    for (const KernelPart part : {KernelPart::static_part, KernelPart::dynamic_part}) {
      const bool is_static = part == KernelPart::static_part;
      const int order = touching_order(tx, ty, adjacency, part);
      std::vector<PairPoint>& rule =
          (is_static ? static_rules_ : dynamic_rules_)[{adjacency, order}];
      if (rule.empty()) rule = touching_rule(adjacency, order, is_static ? kStaticRadial : radial);
    }
  };
  std::vector<std::vector<int>> fans(mesh_.vertices.size());
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    for (int v : mesh_.triangles[t]) fans[v].push_back(static_cast<int>(t));
  for (const std::vector<int>& fan : fans)
    for (int tx : fan)
      for (int ty : fan) need(tx, ty, pair(tx, ty).adjacency);
}

bool PairQuadrature::midpoints_suffice(double distance, double longest_edge,
                                       KernelPart part) const {
  const int rule = rule_at(distance, longest_edge, part);
  return rule >= 0 && triangle_rules()[rule].degree <= 2;
}

/// |s| h/c2 of the longest edge.
double PairQuadrature::longest_wave() const {
  double longest = 0;
  for (const Panel& p : panels_) longest = std::max(longest, p.longest_edge);
  return longest * wave_number_;
}

PairQuadrature::Pairing PairQuadrature::pair(int tx, int ty) const {
  const Triangle &a = mesh_.triangles[tx], &b = mesh_.triangles[ty];
  Pairing p{};
  int shared = 0, rest_x = 3, rest_y = 3;
  for (int i = 0; i < 3; ++i) {
    const auto at = std::find(b.begin(), b.end(), a[i]);
    if (at == b.end()) {
      p.x[--rest_x] = i;
    } else {
      p.x[shared] = i;
      p.y[shared++] = static_cast<int>(at - b.begin());
    }
  }
  for (int j = 0; j < 3; ++j)
    if (std::find(a.begin(), a.end(), b[j]) == a.end()) p.y[--rest_y] = j;
  p.adjacency = static_cast<Adjacency>(shared);
  return p;
}

int PairQuadrature::touching_order(int tx, int ty, Adjacency adjacency, KernelPart part) const {
  const bool is_static = part == KernelPart::static_part;
  int order = is_static ? static_order_ : dynamic_order_;
  const Panel &x = panels_[tx], &y = panels_[ty];
  const auto slenderness = [](const Panel& p) {
    return p.longest_edge * p.longest_edge / (2 * p.area);
  };
  const double slender = std::max(slenderness(x), slenderness(y));
  if (is_static && slender > kSlender)
    order += slender > kVerySlender ? kMoreForVerySlender : kMoreForSlender;
  else if (std::max(x.widest_angle, y.widest_angle) > kObtuse)
    order += kMoreForObtuse;
  if (adjacency == Adjacency::edge && x.normal.dot(y.normal) < (is_static ? kSharp : kFolded))
    order += is_static ? kStaticForEdges : kDynamicForEdges;
  return order;
}

const std::vector<PairPoint>& PairQuadrature::touching_points(int tx, int ty, Adjacency adjacency,
                                                              KernelPart part) const {
  const Rules& rules = part == KernelPart::static_part ? static_rules_ : dynamic_rules_;
  return rules.at({adjacency, touching_order(tx, ty, adjacency, part)});
}

std::array<Vec3, 3> PairQuadrature::corners(int triangle) const {
  const Triangle& t = mesh_.triangles[triangle];
  return {mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]};
}

/// The rules of a pair that does not touch. Far from each other a lower bound of the distance is
/// enough to know them.
std::optional<std::array<int, 2>> PairQuadrature::unsplit_rules(int tx, int ty,
                                                                KernelPart part) const {
  constexpr double kFar = 3;  // of the longest edge
  const Panel &x = panels_[tx], &y = panels_[ty];
  double distance = (x.centre - y.centre).norm() - x.radius - y.radius;
  if (distance < kFar * std::max(x.longest_edge, y.longest_edge)) {
    distance = triangle_distance(corners(tx).data(), corners(ty).data());
  }
  const int rule_x = rule_at(distance, x.longest_edge, part),
            rule_y = rule_at(distance, y.longest_edge, part);
  if (rule_x < 0 || rule_y < 0) return std::nullopt;
  return std::array<int, 2>{rule_x, rule_y};
}

void PairQuadrature::for_each_product(int tx, int ty, KernelPart part,
                                      const std::function<void(const CellProduct&)>& f) const {
  const bool swapped = tx > ty;
  if (swapped) std::swap(tx, ty);
  const auto give = [&](const TriangleCell& x, const TriangleCell& y, int rule_x, int rule_y) {
    f(swapped ? CellProduct{y, x, rule_y, rule_x} : CellProduct{x, y, rule_x, rule_y});
  };
  const TriangleCell of_x(corners(tx)), of_y(corners(ty));
  if (const auto rules = unsplit_rules(tx, ty, part)) {
    give(of_x, of_y, (*rules)[0], (*rules)[1]);
    return;
  }
  struct Task {
    TriangleCell x, y;
    int depth;
  };
  std::vector<Task> stack = {{of_x, of_y, 0}};
  while (!stack.empty()) {
    const Task task = stack.back();
    stack.pop_back();
    const double distance = triangle_distance(task.x.corners().data(), task.y.corners().data());
    const auto rule_of = [&](const TriangleCell& cell) {
      const int rule = rule_at(distance, cell.longest_edge(), part);
      return rule < 0 && task.depth >= kDeepest ? kTriangleRuleCount - 1 : rule;
    };
    const int rule_x = rule_of(task.x), rule_y = rule_of(task.y);
    if (rule_x >= 0 && rule_y >= 0) {
      give(task.x, task.y, rule_x, rule_y);
      continue;
    }
    const bool x_is_larger = task.x.longest_edge() >= task.y.longest_edge();
    const bool split_x = rule_y >= 0 || (rule_x < 0 && x_is_larger);
    for (int i = 0; i < 2; ++i)
      stack.push_back(split_x ? Task{task.x.half(i), task.y, task.depth + 1}
                              : Task{task.x, task.y.half(i), task.depth + 1});
  }
}

}  // namespace bem
