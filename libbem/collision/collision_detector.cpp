#include "collision/collision_detector.hpp"

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "base/parallel.hpp"
#include "collision/edge_contacts.hpp"
#include "collision/mirrored_contacts.hpp"
#include "collision/plane_contacts.hpp"
#include "collision/swept_surface.hpp"
#include "collision/vertex_contacts.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace bem {
namespace {

/// Surfaces whose boxes overlap, or (with second >= number of surfaces) a surface and a plane.
using Pair = std::pair<int, int>;

/// What is known of two close surfaces, or of one with itself.
struct PairState {
  long boxes_a = -1, boxes_b = -1;             ///< versions that `triangles` are of
  long motion_a = -1, motion_b = -1;           ///< versions that `contacts` are of
  std::vector<std::pair<int, int>> triangles;  ///< whose boxes with slack overlap
  std::vector<Contact> contacts;
  bool pressed = false;  ///< `contacts` include pressed ones
};

std::vector<std::pair<int, int>> close_triangles(const SweptSurface& a, const SweptSurface& b) {
  std::vector<std::pair<int, int>> found;
  auto add = [&](int s, int t) { found.emplace_back(s, t); };
  if (a.topology().triangles.empty() || b.topology().triangles.empty()) return found;
  if (&a == &b)
    visit_self_overlaps(a.tree(), 0, add);
  else
    visit_overlaps(a.tree(), 0, b.tree(), 0, add);
  return found;
}

/// Close pairs of features of two surfaces, or of one with itself.
class FeaturePairs {
 public:
  FeaturePairs(const SweptSurface& a, int index_a, const SweptSurface& b, int index_b,
               const ContactLimits& limits, const std::vector<ContactKey>& pressed)
      : a_(a),
        b_(b),
        moving_a_(a.moving(index_a)),
        moving_b_(b.moving(index_b)),
        limits_(limits),
        pressed_(pressed),
        self_(&a == &b) {}

  std::vector<Contact> contacts(const std::vector<std::pair<int, int>>& triangles) {
    for (const auto& [s, t] : triangles)
      if (overlap(a_.triangle_box(s), b_.triangle_box(t))) add_triangles(s, t);
    add_vertices(vertices_of_a_, moving_a_, moving_b_);
    add_vertices(vertices_of_b_, moving_b_, moving_a_);
    if (!self_) remove_mirrored(limits_, moving_a_, moving_b_, contacts_);
    return std::move(contacts_);
  }

 private:
  void add_triangles(int s, int t) {
    collect_vertices(a_, s, b_, t, vertices_of_a_);
    collect_vertices(b_, t, a_, s, self_ ? vertices_of_a_ : vertices_of_b_);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (a_.topology().owned_edges[s] >> i & 1 && b_.topology().owned_edges[t] >> j & 1)
          add_edges(a_.topology().triangle_edges[s][i], b_.topology().triangle_edges[t][j]);
  }

  /// Vertices that triangle s owns, close to triangle t of the other surface.
  void collect_vertices(const SweptSurface& x, int s, const SweptSurface& y, int t,
                        std::vector<std::pair<int, int>>& pairs) const {
    if (x.topology().owned_vertices[s] == 0) return;
    const BoundingBox box = y.triangle_box(t);
    const Triangle& other = y.topology().triangles[t];
    for (int k = 0; k < 3; ++k) {
      const int v = x.topology().triangles[s][k];
      if (!(x.topology().owned_vertices[s] >> k & 1) || !overlap(x.vertex_box(v), box)) continue;
      if (self_ && std::find(other.begin(), other.end(), v) != other.end()) continue;
      pairs.emplace_back(v, t);
    }
  }

  void add_edges(int e, int f) {
    if (!a_.is_ridge(e) || !b_.is_ridge(f) || !overlap(a_.edge_box(e), b_.edge_box(f))) return;
    if (self_) {
      if (e > f) std::swap(e, f);
      const auto& p = a_.topology().edges[e].vertices;
      const auto& q = a_.topology().edges[f].vertices;
      if (p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1]) return;
    }
    const ContactKey key{moving_a_.index, moving_b_.index, ContactKind::edge_edge, e, f};
    const bool pressed = std::binary_search(pressed_.begin(), pressed_.end(), key);
    add_edge_contact(moving_a_, e, moving_b_, f, pressed, limits_, contacts_);
  }

  /// The triangle of y that has held the vertex of x, -1 if none has.
  int pressed_triangle(const MovingSurface& x, int vertex, const MovingSurface& y) const {
    const ContactKey first{x.index, y.index, ContactKind::vertex_triangle, vertex, 0};
    const auto it = std::lower_bound(pressed_.begin(), pressed_.end(), first);
    const bool found = it != pressed_.end() && it->surface_a == x.index &&
                       it->surface_b == y.index && it->kind == ContactKind::vertex_triangle &&
                       it->feature_a == vertex;
    return found ? it->feature_b : -1;
  }

  void add_vertices(std::vector<std::pair<int, int>>& pairs, const MovingSurface& x,
                    const MovingSurface& y) {
    std::sort(pairs.begin(), pairs.end());
    std::vector<int> triangles;
    for (std::size_t i = 0; i < pairs.size();) {
      check_interruption();
      const int vertex = pairs[i].first;
      triangles.clear();
      for (; i < pairs.size() && pairs[i].first == vertex; ++i)
        triangles.push_back(pairs[i].second);
      add_vertex_contacts(x, vertex, y, triangles.data(), triangles.data() + triangles.size(),
                          pressed_triangle(x, vertex, y), limits_, contacts_);
    }
  }

  const SweptSurface& a_;
  const SweptSurface& b_;
  MovingSurface moving_a_, moving_b_;
  ContactLimits limits_;
  const std::vector<ContactKey>& pressed_;
  bool self_;
  std::vector<std::pair<int, int>> vertices_of_a_, vertices_of_b_;  ///< with triangles of the other
  std::vector<Contact> contacts_;
};

/// Does the box come to within a distance of the half space?
bool reaches(const BoundingBox& box, const CollisionPlane& plane, double distance) {
  double lowest = -plane.normal.dot(plane.point);
  for (int k = 0; k < 3; ++k)
    lowest += plane.normal[k] * (plane.normal[k] > 0 ? box.min[k] : box.max[k]);
  return lowest <= distance;
}

}  // namespace

struct CollisionDetector::State {
  std::vector<SweptSurface> surfaces;
  std::vector<char> prescribed, self_contact;
  std::vector<double> recovery_depth;  ///< by surface [m]
  std::vector<CollisionPlane> planes;
  CollisionOptions options;  ///< ignored pairs with the first < second, sorted

  bool is_allowed(int a, int b) const {
    const auto& ignored = options.ignored_pairs;
    return !std::binary_search(ignored.begin(), ignored.end(), Pair(std::minmax(a, b)));
  }

  std::vector<ContactKey> pressed;  ///< see detect()
  double deepest = 0;               ///< of them [m]

  /// Distance at which surfaces see each other [m].
  double reach() const { return std::max({options.margin, options.recovery_depth, 1.5 * deepest}); }
  /// Surfaces with pressed contacts between them.
  bool is_pressed(const Pair& pair) const;

  std::map<Pair, PairState> pairs;  ///< of the last detection

  /// Every pair that may have contacts, first < second, sorted.
  std::vector<Pair> close_pairs() const;
  /// Takes the pairs, with what is known of them already.
  std::vector<std::pair<const Pair, PairState>*> keep_pairs(const std::vector<Pair>& close);
  void update(const Pair& pair, PairState& known) const;
};

bool CollisionDetector::State::is_pressed(const Pair& pair) const {
  return std::any_of(pressed.begin(), pressed.end(), [&](const ContactKey& key) {
    return std::minmax(key.surface_a, key.surface_b) == std::minmax(pair.first, pair.second);
  });
}

std::vector<Pair> CollisionDetector::State::close_pairs() const {
  const int count = static_cast<int>(surfaces.size());
  std::vector<BoundingBox> boxes;
  for (const SweptSurface& surface : surfaces) boxes.push_back(surface.box());
  std::vector<Pair> close;
  for (const auto& [a, b] : overlapping_pairs(boxes))
    if (!(prescribed[a] && prescribed[b]) && is_allowed(a, b)) close.emplace_back(a, b);
  for (int a = 0; a < count; ++a) {
    if (self_contact[a]) close.emplace_back(a, a);
    for (std::size_t p = 0; p < planes.size(); ++p)
      // without the slack, which remembers where the surface has been
      if (!prescribed[a] && reaches(surfaces[a].swept_box(), planes[p], 0.5 * reach()) &&
          is_allowed(a, count + static_cast<int>(p)))
        close.emplace_back(a, count + static_cast<int>(p));
  }
  std::sort(close.begin(), close.end());
  return close;
}

std::vector<std::pair<const Pair, PairState>*> CollisionDetector::State::keep_pairs(
    const std::vector<Pair>& close) {
  std::map<Pair, PairState> kept;
  for (const Pair& pair : close) {
    const auto known = pairs.find(pair);
    kept.emplace_hint(kept.end(), pair,
                      known == pairs.end() ? PairState() : std::move(known->second));
  }
  pairs = std::move(kept);
  std::vector<std::pair<const Pair, PairState>*> out;
  for (auto& entry : pairs) out.push_back(&entry);
  return out;
}

/// Finds the contacts of a pair; what cannot have changed since the last time is kept.
void CollisionDetector::State::update(const Pair& pair, PairState& known) const {
  const auto [a, b] = pair;
  const int count = static_cast<int>(surfaces.size());
  const SweptSurface& surface = surfaces[a];
  if (b >= count) {
    known.contacts.clear();
    const CollisionPlane& plane = planes[b - count];
    add_plane_contacts(surface.moving(a), b, plane.point, plane.normal, options, known.contacts);
    return;
  }
  const SweptSurface& other = surfaces[b];
  const bool pressed_now = is_pressed(pair);
  if (known.motion_a == surface.motion_version() && known.motion_b == other.motion_version() &&
      !pressed_now && !known.pressed)
    return;
  known.pressed = pressed_now;
  known.motion_a = surface.motion_version();
  known.motion_b = other.motion_version();
  if (known.boxes_a != surface.boxes_version() || known.boxes_b != other.boxes_version()) {
    known.boxes_a = surface.boxes_version();
    known.boxes_b = other.boxes_version();
    known.triangles = close_triangles(surface, other);
  }
  ContactLimits limits = options;
  limits.recovery_depth = std::min({limits.recovery_depth, recovery_depth[a], recovery_depth[b]});
  // The other side of a thin wall is near, but nothing has come through it.
  if (a == b) limits.recovery_depth = limits.tolerance;
  known.contacts = FeaturePairs(surface, a, other, b, limits, pressed).contacts(known.triangles);
}

CollisionDetector::CollisionDetector(std::vector<CollisionSurface> surfaces,
                                     std::vector<CollisionPlane> planes, CollisionOptions options)
    : state_(std::make_unique<State>()) {
  state_->planes = std::move(planes);
  state_->options = std::move(options);
  auto& ignored = state_->options.ignored_pairs;
  for (Pair& pair : ignored) pair = Pair(std::minmax(pair.first, pair.second));
  std::sort(ignored.begin(), ignored.end());
  for (const CollisionSurface& s : surfaces) {
    state_->surfaces.emplace_back(make_topology(s.triangles, s.vertex_count));
    state_->prescribed.push_back(s.prescribed);
    state_->self_contact.push_back(s.self_contact);
    state_->recovery_depth.push_back(s.recovery_depth);
  }
}

CollisionDetector::~CollisionDetector() = default;
CollisionDetector::CollisionDetector(CollisionDetector&&) noexcept = default;
CollisionDetector& CollisionDetector::operator=(CollisionDetector&&) noexcept = default;

const Triangle& CollisionDetector::triangle(int surface, int triangle) const {
  return state_->surfaces[surface].topology().triangles[triangle];
}

const std::array<int, 2>& CollisionDetector::edge(int surface, int edge) const {
  return state_->surfaces[surface].topology().edges[edge].vertices;
}

bool CollisionDetector::is_allowed(int a, int b) const {
  return state_->is_allowed(a, b);
}

std::vector<Contact> CollisionDetector::detect(const std::vector<SurfaceMotion>& motions,
                                               const std::vector<ContactKey>& pressed,
                                               double deepest) {
  State& state = *state_;
  state.pressed = pressed;
  state.deepest = deepest;
  require(motions.size() == state.surfaces.size(), "every surface has a motion");
  const double reach = state.reach();
  std::vector<SweptSurface>& surfaces = state.surfaces;
  parallel_for(motions.size(), [&](std::size_t i) {
    surfaces[i].sweep(*motions[i].start, *motions[i].end, reach);
  });
  const std::vector<Pair> close = state.close_pairs();
  std::vector<char> used(motions.size(), 0);
  for (const auto& [a, b] : close)
    if (b < static_cast<int>(motions.size())) used[a] = used[b] = 1;
  parallel_for(motions.size(), [&](std::size_t i) {
    if (used[i]) surfaces[i].prepare();
  });
  const auto pairs = state.keep_pairs(close);
  parallel_for(pairs.size(),
               [&](std::size_t i) { state.update(pairs[i]->first, pairs[i]->second); });
  std::vector<Contact> contacts;
  for (const auto* pair : pairs)
    contacts.insert(contacts.end(), pair->second.contacts.begin(), pair->second.contacts.end());
  std::sort(contacts.begin(), contacts.end(),
            [](const Contact& x, const Contact& y) { return x.key < y.key; });
  return contacts;
}

}  // namespace bem
