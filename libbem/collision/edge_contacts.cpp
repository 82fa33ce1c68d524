#include "collision/edge_contacts.hpp"

#include "collision/coplanarity.hpp"
#include "mesh/closest_points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

namespace bem {
namespace {

constexpr double kParallel = 1e-3;  ///< sine of the angle between edges that count as parallel
constexpr double kFlat = 1e-4;      ///< [rad]
constexpr double kDeepest = 4;      ///< of the recovery depth

/// Both edges at one time, where they can touch.
struct Approach {
  double time = 0;
  Vec3 normal;  ///< from b to a
  double s = 0, u = 0;
  double gap = 0;        ///< [m]
  double direction = 1;  ///< normal = direction * (edge a) x (edge b), normalised
};

class EdgePair {
 public:
  EdgePair(const MovingSurface& a, int edge_a, const MovingSurface& b, int edge_b, bool pressed,
           const ContactLimits& limits)
      : a_(a), b_(b), edge_a_(edge_a), edge_b_(edge_b), pressed_(pressed), limits_(limits) {
    ends_a_ = a.topology->edges[edge_a].vertices;
    ends_b_ = b.topology->edges[edge_b].vertices;
  }

  std::optional<Contact> find() const {
    const std::optional<Approach> start = approach(0);
    if (start && start->gap <= limits_.tolerance &&
        (start->gap >= -limits_.recovery_depth || pressed_))
      return contact(*start);
    if (const auto hit = first_hit()) return contact(*hit);
    const std::optional<Approach> end = approach(1);
    if (end && end->gap < limits_.margin && is_recent(*end)) return contact(*end);
    return std::nullopt;
  }

 private:
  /// The edges at time t if inner points of both are closest there and the direction between them
  /// is a normal of both surfaces.
  std::optional<Approach> approach(double t) const {
    const Vec3 p = a_.vertex(ends_a_[0], t), q = a_.vertex(ends_a_[1], t);
    const Vec3 r = b_.vertex(ends_b_[0], t), v = b_.vertex(ends_b_[1], t);
    const LinePair lines = closest_on_lines(p, q, r, v);
    if (lines.sine < kParallel || !is_inner(lines.s, q - p) || !is_inner(lines.u, v - r))
      return std::nullopt;
    const NormalArc arc_a = normal_arc(a_, edge_a_, t), arc_b = normal_arc(b_, edge_b_, t);
    if (arc_a.angle < kFlat || arc_b.angle < kFlat) return std::nullopt;
    Approach result;
    result.time = t;
    result.s = lines.s;
    result.u = lines.u;
    result.normal = (q - p).cross(v - r).normalized();
    result.direction = result.normal.dot(arc_b.first + arc_b.second) > 0 ? 1 : -1;
    result.normal *= result.direction;
    if (!arc_b.contains(result.normal) || !arc_a.contains(-result.normal)) return std::nullopt;
    result.gap = result.normal.dot(p + lines.s * (q - p) - r - lines.u * (v - r));
    return result;
  }

  /// Near its ends an edge is a vertex, whose contacts are those with triangles.
  bool is_inner(double s, const Vec3& edge) const {
    const double end = 2 * limits_.tolerance / edge.norm();
    return s > end && s < 1 - end;
  }

  /// Edges that end in each other without a hit of their own, since they came together over a
  /// vertex or while they touched: is it not deep, or has it come to that in this step?
  bool is_recent(const Approach& end) const {
    if (end.gap >= -limits_.recovery_depth) return true;
    const double before =
        end.normal.dot(point(a_, ends_a_, end.s, 0) - point(b_, ends_b_, end.u, 0));
    return before >= -limits_.recovery_depth && end.gap >= -kDeepest * limits_.recovery_depth;
  }

  static Vec3 point(const MovingSurface& x, const std::array<int, 2>& ends, double s, double t) {
    return (1 - s) * x.vertex(ends[0], t) + s * x.vertex(ends[1], t);
  }

  std::optional<Approach> first_hit() const {
    const auto vector = [](const MovingSurface& x, int i, const MovingSurface& y, int j) {
      return LinearVector{x.vertex(i, 0) - y.vertex(j, 0), x.change(i) - y.change(j)};
    };
    const Crossings crossings = sign_changes(triple_product(
        vector(a_, ends_a_[0], b_, ends_b_[0]), vector(a_, ends_a_[1], a_, ends_a_[0]),
        vector(b_, ends_b_[1], b_, ends_b_[0])));
    for (int i = 0; i < crossings.count; ++i) {
      std::optional<Approach> hit = approach(crossings.at[i].time);
      if (hit && crossings.at[i].falling == (hit->direction > 0)) return hit;
    }
    return std::nullopt;
  }

  /// Right beside a vertex of one edge, does that vertex lie over a face at the other edge, less
  /// deep below it than the edges are in each other? Then it is pushed out there, as in
  /// vertex_contacts.cpp.
  bool is_held_beside(const Approach& x, double gap_end) const {
    return is_held_beside(a_, ends_a_, x.s, b_, edge_b_, x.normal, x.time, gap_end) ||
           is_held_beside(b_, ends_b_, x.u, a_, edge_a_, -x.normal, x.time, gap_end);
  }

  bool is_held_beside(const MovingSurface& x, const std::array<int, 2>& ends, double s,
                      const MovingSurface& y, int edge_y, const Vec3& normal, double t,
                      double gap_end) const {
    const int v = ends[s < 0.5 ? 0 : 1];
    const double length = (x.vertex(ends[1], t) - x.vertex(ends[0], t)).norm();
    if (std::min(s, 1 - s) * length > kRim * limits_.margin) return false;
    const SurfaceTopology::Edge& e = y.topology->edges[edge_y];
    for (int triangle : e.triangles) {
      if (triangle < 0) continue;
      const TrianglePlace place = place_at_triangle(x.vertex(v, t), y, triangle, t);
      if (place.normal.dot(normal) < kSameSide && place.overhang <= 3 * limits_.tolerance &&
          is_tip(x, v, t, place.normal) &&
          place.normal.dot(x.vertex(v, 1) - y.vertex(e.vertices[0], 1)) >
              std::min(gap_end, -kRim * limits_.margin))
        return true;
    }
    return false;
  }

  std::optional<Contact> contact(const Approach& approach) const {
    // The points that are closest at the end; if the edges have slid off each other, those or the
    // ones that met, whichever are deeper.
    const LinePair lines = closest_on_lines(a_.vertex(ends_a_[0], 1), a_.vertex(ends_a_[1], 1),
                                            b_.vertex(ends_b_[0], 1), b_.vertex(ends_b_[1], 1));
    const double last_s = std::clamp(lines.s, 0.0, 1.0), last_u = std::clamp(lines.u, 0.0, 1.0);
    const auto gap = [&](double s, double u) {
      return approach.normal.dot(point(a_, ends_a_, s, 1) - point(b_, ends_b_, u, 1));
    };
    const bool last =
        lines.sine >= kParallel && ((last_s == lines.s && last_u == lines.u) ||
                                    gap(last_s, last_u) < gap(approach.s, approach.u));
    const double s = last ? last_s : approach.s, u = last ? last_u : approach.u;
    Contact c;
    c.a = {a_.index, 2, {ends_a_[0], ends_a_[1], -1}, {1 - s, s, 0}};
    c.b = {b_.index, 2, {ends_b_[0], ends_b_[1], -1}, {1 - u, u, 0}};
    c.normal = approach.normal;
    if (last && last_s == lines.s && last_u == lines.u) {
      // where nothing changes to first order as the points slide along the edges
      const Vec3 end = (a_.vertex(ends_a_[1], 1) - a_.vertex(ends_a_[0], 1))
                           .cross(b_.vertex(ends_b_[1], 1) - b_.vertex(ends_b_[0], 1))
                           .normalized() *
                       approach.direction;
      if (end.dot(approach.normal) > kTurned) c.normal = end;
    }
    c.point = c.b.place(*b_.end);
    c.offset_start = c.a.place(*a_.start) - c.b.place(*b_.start);
    c.gap_start = c.normal.dot(c.offset_start);
    c.gap_end = c.normal.dot(c.a.place(*a_.end) - c.point);
    c.key = {a_.index, b_.index, ContactKind::edge_edge, edge_a_, edge_b_};
    if (c.gap_end >= limits_.margin || is_held_beside(approach, c.gap_end)) return std::nullopt;
    return c;
  }

  const MovingSurface& a_;
  const MovingSurface& b_;
  int edge_a_, edge_b_;
  bool pressed_;
  const ContactLimits& limits_;
  std::array<int, 2> ends_a_, ends_b_;
};

}  // namespace

void add_edge_contact(const MovingSurface& a, int edge_a, const MovingSurface& b, int edge_b,
                      bool pressed, const ContactLimits& limits, std::vector<Contact>& contacts) {
  if (const auto contact = EdgePair(a, edge_a, b, edge_b, pressed, limits).find())
    contacts.push_back(*contact);
}

}  // namespace bem
