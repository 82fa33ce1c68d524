#include "collision/vertex_contacts.hpp"

#include "collision/coplanarity.hpp"
#include "mesh/closest_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <Eigen/Geometry>

namespace bem {
namespace {

constexpr double kSteepest = 0.6;          ///< sine of the steepest way from one to the other
constexpr double kSameDirection = 0.9998;  ///< cosine above which two normals are one

struct Candidate {
  int triangle;
  TrianglePlace start, end;
};

/// A triangle that may hold the vertex.
struct Proposal {
  double time;  ///< of the impact; 1 if it only ends near
  Vec3 normal;  ///< of the triangle at that time
  int triangle;
  std::array<double, 3> weights;  ///< of the point in it
  Vec3 point;                     ///< that point at the end
  double gap_end;
};

class VertexContacts {
 public:
  VertexContacts(const MovingSurface& a, int vertex, const MovingSurface& b, int pressed,
                 const ContactLimits& limits)
      : a_(a),
        b_(b),
        vertex_(vertex),
        pressed_(pressed),
        limits_(limits),
        inclusive_(3 * limits.tolerance),
        rim_(kRim * limits.margin),
        start_(a.vertex(vertex, 0)),
        end_(a.vertex(vertex, 1)) {}

  void add(const int* first, const int* last, std::vector<Contact>& contacts) {
    candidates_.reserve(last - first);
    for (; first != last; ++first) {
      Candidate c{*first, place_at_triangle(start_, b_, *first, 0),
                  place_at_triangle(end_, b_, *first, 1)};
      // what has no area has no side to be on
      if (!c.start.normal.isZero(0) && !c.end.normal.isZero(0)) candidates_.push_back(c);
    }
    propose_entered();
    propose_near();
    for (const Proposal& p : proposals_)
      if (is_needed(p) && faces(a_, vertex_, p.time, p.normal)) accepted_.push_back(p);
    if (entered_ && !is_held()) accept_inside();
    for (const Proposal& p : accepted_) contacts.push_back(contact(p));
    if (backward_) contacts.back().backward = true;
  }

 private:
  /// Triangles the vertex touches at the start or goes through later, the earliest first.
  void propose_entered() {
    const Nearest near = nearest_at(0);
    const bool inside = near.inside && near.distance <= limits_.recovery_depth;
    for (const Candidate& c : candidates_) {
      if (touches_at_start(c.start, inside, near.distance)) {
        propose_hit(c, 0, c.start);
      } else {
        propose_crossed(c);
      }
    }
    std::sort(proposals_.begin(), proposals_.end(), [](const Proposal& x, const Proposal& y) {
      return std::make_tuple(x.time, -x.gap_end, x.triangle) <
             std::make_tuple(y.time, -y.gap_end, y.triangle);
    });
  }

  /// What the vertex is nearest to at the start (t = 0) or at the end (t = 1), and the outward
  /// normal there; none without candidates.
  struct Nearest {
    const Candidate* candidate = nullptr;
    double distance = std::numeric_limits<double>::infinity();
    Vec3 normal = Vec3::Zero();
    bool inside = false;  ///< is the vertex on the inner side?
  };
  Nearest nearest_at(int t) const {
    const Vec3& place = t == 0 ? start_ : end_;
    Nearest best;
    for (const Candidate& c : candidates_) {
      const double distance = (place - (t == 0 ? c.start : c.end).closest.point).norm();
      if (distance < best.distance) best = {&c, distance, Vec3::Zero(), false};
    }
    if (!best.candidate) return best;
    const TrianglePlace& on = t == 0 ? best.candidate->start : best.candidate->end;
    best.normal = on.normal;
    if (on.closest.feature == NearestPoint::Feature::edge)
      best.normal = edge_normal(
          b_, b_.topology->triangle_edges[best.candidate->triangle][on.closest.index], t);
    if (on.closest.feature == NearestPoint::Feature::corner)
      best.normal =
          vertex_normal(b_, b_.topology->triangles[best.candidate->triangle][on.closest.index], t);
    best.inside = best.normal.dot(place - on.closest.point) < 0;
    return best;
  }

  /// Does what is accepted know that the vertex ends in the surface?
  bool is_held() const {
    return std::any_of(accepted_.begin(), accepted_.end(),
                       [&](const Proposal& p) { return p.gap_end < -limits_.tolerance; });
  }

  /// A vertex that has entered the surface and ends in it may end above the planes of all triangles
  /// that it could be held by, because they turn in the step: then it is held by what is nearest.
  void accept_inside() {
    const Nearest near = nearest_at(1);
    if (!near.inside || near.distance <= limits_.tolerance) return;
    const auto is_known = [&](const Proposal& p) { return p.triangle == near.candidate->triangle; };
    if (std::any_of(accepted_.begin(), accepted_.end(), is_known)) return;
    const NearestPoint& on = near.candidate->end.closest;
    const Vec3 normal = near.normal.normalized();
    backward_ = true;
    accepted_.push_back(
        {1, normal, near.candidate->triangle, on.weights, on.point, normal.dot(end_ - on.point)});
  }

  bool touches_at_start(const TrianglePlace& start, bool inside, double nearest) const {
    if (start.height > limits_.tolerance) return false;
    if (start.height < -limits_.recovery_depth) return is_pressed_against(start);
    if (start.height >= -limits_.tolerance && start.overhang <= inclusive_) return true;
    return inside && (start_ - start.closest.point).norm() <=
                         std::min(nearest + limits_.tolerance, limits_.recovery_depth);
  }

  /// Deeper than the recovery depth: is this the side that held the vertex in the step before?
  bool is_pressed_against(const TrianglePlace& start) const {
    return pressed_ >= 0 && start.overhang <= inclusive_ &&
           start.normal.dot(triangle_normal(b_, pressed_, 0)) > kSameSide;
  }

  void propose_crossed(const Candidate& c) {
    const Triangle& t = b_.topology->triangles[c.triangle];
    const Vec3 corner = b_.vertex(t[0], 0), moved = b_.change(t[0]);
    const Crossings crossings =
        sign_changes(triple_product({start_ - corner, a_.change(vertex_) - moved},
                                    {b_.vertex(t[1], 0) - corner, b_.change(t[1]) - moved},
                                    {b_.vertex(t[2], 0) - corner, b_.change(t[2]) - moved}));
    for (int i = 0; i < crossings.count; ++i) {
      const double time = crossings.at[i].time;
      if (!crossings.at[i].falling) continue;
      const TrianglePlace hit = place_at_triangle(a_.vertex(vertex_, time), b_, c.triangle, time);
      if (hit.overhang > inclusive_) continue;
      entered_ = true;
      propose_hit(c, time, hit);
      return;
    }
  }

  /// The triangle beyond a sharp convex edge of `triangle` that the place is right beside, if the
  /// vertex can as well be pushed out on that side; null without one.
  const Candidate* beyond_edge(int triangle, const TrianglePlace& place, double t) const {
    const Triangle& corners = b_.topology->triangles[triangle];
    for (int k = 0; k < 3; ++k) {
      const auto& sides = b_.topology->edges[b_.topology->triangle_edges[triangle][k]].triangles;
      const int other = sides[0] == triangle ? sides[1] : sides[0];
      if (other < 0) continue;
      const Vec3 p = b_.vertex(corners[k], t), q = b_.vertex(corners[(k + 1) % 3], t);
      const Vec3 r = b_.vertex(corners[(k + 2) % 3], t);
      const double altitude = (q - p).cross(r - p).norm() / (q - p).norm();
      if (place.closest.weights[(k + 2) % 3] * altitude > rim_) continue;
      const Vec3 n = triangle_normal(b_, other, t);
      if (n.dot(r - p) >= 0 || n.dot(place.normal) > kSameSide || !is_tip(a_, vertex_, t, n))
        continue;
      const auto found = std::find_if(candidates_.begin(), candidates_.end(),
                                      [&](const Candidate& c) { return c.triangle == other; });
      if (found != candidates_.end()) return &*found;
    }
    return nullptr;
  }

  /// The vertex enters the surface at `hit`. Right beside a sharp edge it is pushed out on the
  /// side where it ends less deep, so that bodies set flush do not catch on each other.
  void propose_hit(const Candidate& c, double time, const TrianglePlace& hit) {
    const Candidate* beyond = beyond_edge(c.triangle, hit, time);
    const bool shorter = beyond && beyond->end.normal.dot(end_ - beyond->end.closest.point) >
                                       c.end.normal.dot(end_ - c.end.closest.point);
    if (shorter)
      propose_at_end(*beyond, time, beyond->start.closest.weights);
    else
      propose_at_end(c, time, hit.closest.weights);
  }

  /// The vertex has entered the surface through triangle c at `time`, at its point `weights`; it is
  /// held by the nearest triangle under its end that is reached from there without a steep way, or
  /// else where it entered.
  void propose_at_end(const Candidate& c, double time, const std::array<double, 3>& weights) {
    const Vec3 entered = triangle_normal(b_, c.triangle, time);
    const auto [p, q, r] = b_.triangle(c.triangle, 1);
    const Vec3 entry = weights[0] * p + weights[1] * q + weights[2] * r;
    const Candidate* under = nullptr;
    Vec3 normal = entered;
    for (const Candidate& other : candidates_) {
      if (other.end.overhang > inclusive_ ||
          (under && std::abs(other.end.height) >= std::abs(under->end.height)))
        continue;
      const Vec3 n = triangle_normal(b_, other.triangle, time);
      const Vec3 way = other.end.closest.point - entry;
      if (n.dot(entered) < kSameSide ||
          std::abs(entered.dot(way)) > kSteepest * way.norm() + limits_.tolerance ||
          !faces(a_, vertex_, time, n))
        continue;
      under = &other;
      normal = n;
    }
    if (under)
      propose(time, normal, under->triangle, under->end.closest.weights);
    else
      propose(time, entered, c.triangle, weights);
  }

  void propose(double time, const Vec3& normal, int triangle,
               const std::array<double, 3>& weights) {
    const auto [p, q, r] = b_.triangle(triangle, 1);
    const Vec3 point = weights[0] * p + weights[1] * q + weights[2] * r;
    const Vec3 turned = triangle_normal(b_, triangle, 1);
    const Vec3& n = turned.dot(normal) > kTurned ? turned : normal;
    const double gap = n.dot(end_ - point);
    if (gap < limits_.margin) proposals_.push_back({time, n, triangle, weights, point, gap});
  }

  /// Triangles the vertex ends above, the nearest first.
  void propose_near() {
    const auto entered = static_cast<std::ptrdiff_t>(proposals_.size());
    for (const Candidate& c : candidates_) {
      if (c.end.overhang > inclusive_ || c.end.height < -limits_.tolerance ||
          c.end.height >= limits_.margin)
        continue;
      const Candidate* beyond = beyond_edge(c.triangle, c.end, 1);
      if (!beyond || beyond->end.normal.dot(end_ - beyond->end.closest.point) < -rim_)
        propose(1, c.end.normal, c.triangle, c.end.closest.weights);
    }
    std::sort(proposals_.begin() + entered, proposals_.end(),
              [](const Proposal& x, const Proposal& y) {
                return std::tie(x.gap_end, x.triangle) < std::tie(y.gap_end, y.triangle);
              });
  }

  /// Does the proposal add something to what is accepted: another direction, and a wall that stands
  /// in front of the others and they in front of it?
  bool is_needed(const Proposal& p) const {
    for (const Proposal& q : accepted_)
      if (q.triangle == p.triangle || p.normal.dot(q.normal) > kSameDirection ||
          !is_in_front(p, q) || !is_in_front(q, p))
        return false;
    return true;
  }

  /// Is what x holds the vertex above in front of y? Where both are at one place, the whole
  /// triangles tell.
  bool is_in_front(const Proposal& x, const Proposal& y) const {
    const Vec3 way = x.point - y.point;
    if (way.norm() > 10 * inclusive_) return y.normal.dot(way) >= -limits_.tolerance;
    const auto [p, q, r] = b_.triangle(x.triangle, 1);
    return y.normal.dot((p + q + r) / 3 - y.point) > 0;
  }

  Contact contact(const Proposal& p) const {
    const Triangle& t = b_.topology->triangles[p.triangle];
    Contact c;
    c.a = {a_.index, 1, {vertex_, -1, -1}, {1, 0, 0}};
    c.b = {b_.index, 3, t, p.weights};
    c.normal = p.normal;
    c.point = p.point;
    c.offset_start = start_ - c.b.place(*b_.start);
    c.gap_start = c.normal.dot(c.offset_start);
    c.gap_end = p.gap_end;
    c.key = {a_.index, b_.index, ContactKind::vertex_triangle, vertex_, p.triangle};
    return c;
  }

  const MovingSurface& a_;
  const MovingSurface& b_;
  int vertex_, pressed_;
  const ContactLimits& limits_;
  double inclusive_;  ///< a foot this far outside a triangle is still on it [m]
  double rim_;        ///< a foot this far inside a triangle is beside its edge [m]
  Vec3 start_, end_;
  bool entered_ = false;   ///< the vertex goes through a triangle in the step
  bool backward_ = false;  ///< see Contact::backward
  std::vector<Candidate> candidates_;
  std::vector<Proposal> proposals_, accepted_;
};

}  // namespace

void add_vertex_contacts(const MovingSurface& a, int vertex, const MovingSurface& b,
                         const int* first, const int* last, int pressed,
                         const ContactLimits& limits, std::vector<Contact>& contacts) {
  VertexContacts(a, vertex, b, pressed, limits).add(first, last, contacts);
}

}  // namespace bem
