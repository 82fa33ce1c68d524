#include "contact/collision_detector.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "contact/bounding_tree.hpp"
#include "contact/edge_contacts.hpp"
#include "contact/mirrored_contacts.hpp"
#include "contact/moving_surface.hpp"
#include "contact/plane_contacts.hpp"
#include "contact/surface_topology.hpp"
#include "contact/vertex_contacts.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

namespace bem {
namespace {

/// Surfaces whose boxes overlap, or (with second >= number of surfaces) a surface and a plane.
using Pair = std::pair<int, int>;

/// A surface with the boxes of what its parts sweep during the step, widened by half the distance
/// at which surfaces see each other.
struct SweptSurface {
  SurfaceTopology topology;
  std::optional<BoundingTree> tree;
  std::vector<BoundingBox> vertex_boxes;
  BoundingBox box;
  std::vector<Vec3> resting;  ///< where it was when its boxes were last made, if it did not move
  bool refit = false;

  void sweep(const SurfaceMotion& motion, double reach);

  BoundingBox triangle_box(int t) const {
    const Triangle& c = topology.triangles[t];
    BoundingBox result = vertex_boxes[c[0]];
    extend(result, vertex_boxes[c[1]]);
    extend(result, vertex_boxes[c[2]]);
    return result;
  }
  BoundingBox edge_box(int e) const {
    const auto& ends = topology.edges[e].vertices;
    BoundingBox result = vertex_boxes[ends[0]];
    extend(result, vertex_boxes[ends[1]]);
    return result;
  }
};

void SweptSurface::sweep(const SurfaceMotion& motion, double reach) {
  const std::vector<Vec3>&start = *motion.start, &end = *motion.end;
  require(static_cast<int>(start.size()) == topology.vertex_count() && end.size() == start.size(),
          "a motion has the vertices of its surface");
  const bool rests = motion.start == motion.end || start == end;
  if (rests && !resting.empty() && resting == start) return;
  resting = rests ? start : std::vector<Vec3>();
  const Vec3 wide = Vec3::Constant(0.5 * reach);
  vertex_boxes.resize(start.size());
  for (std::size_t v = 0; v < start.size(); ++v)
    vertex_boxes[v] = {start[v].cwiseMin(end[v]) - wide, start[v].cwiseMax(end[v]) + wide};
  box = vertex_boxes.empty() ? BoundingBox() : vertex_boxes.front();
  for (const BoundingBox& b : vertex_boxes) extend(box, b);
  if (!tree) tree.emplace(topology.triangles, start);
  refit = true;
}

/// Close pairs of features of two surfaces, or of one with itself.
class FeaturePairs {
 public:
  FeaturePairs(const SweptSurface& a, const MovingSurface& moving_a, const SweptSurface& b,
               const MovingSurface& moving_b, const ContactLimits& limits)
      : a_(a), b_(b), moving_a_(moving_a), moving_b_(moving_b), limits_(limits), self_(&a == &b) {}

  std::vector<Contact> contacts() {
    if (a_.topology.triangles.empty() || b_.topology.triangles.empty()) return {};
    if (self_)
      visit_self_overlaps(*a_.tree, 0, *this);
    else
      visit_overlaps(*a_.tree, 0, *b_.tree, 0, *this);
    add_vertices(vertices_of_a_, moving_a_, moving_b_);
    add_vertices(vertices_of_b_, moving_b_, moving_a_);
    if (!self_) remove_mirrored(limits_, moving_a_, moving_b_, contacts_);
    return std::move(contacts_);
  }

  /// Triangle s of surface a and t of surface b are close.
  void operator()(int s, int t) {
    collect_vertices(a_, s, b_, t, vertices_of_a_);
    collect_vertices(b_, t, a_, s, self_ ? vertices_of_a_ : vertices_of_b_);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (a_.topology.owned_edges[s] >> i & 1 && b_.topology.owned_edges[t] >> j & 1)
          add_edges(a_.topology.triangle_edges[s][i], b_.topology.triangle_edges[t][j]);
  }

 private:
  /// Vertices that triangle s owns, close to triangle t of the other surface.
  void collect_vertices(const SweptSurface& x, int s, const SweptSurface& y, int t,
                        std::vector<std::pair<int, int>>& pairs) const {
    if (x.topology.owned_vertices[s] == 0) return;
    const BoundingBox box = y.triangle_box(t);
    const Triangle& other = y.topology.triangles[t];
    for (int k = 0; k < 3; ++k) {
      const int v = x.topology.triangles[s][k];
      if (!(x.topology.owned_vertices[s] >> k & 1) || !overlap(x.vertex_boxes[v], box)) continue;
      if (self_ && std::find(other.begin(), other.end(), v) != other.end()) continue;
      pairs.emplace_back(v, t);
    }
  }

  void add_edges(int e, int f) {
    if (!overlap(a_.edge_box(e), b_.edge_box(f))) return;
    if (self_) {
      if (e > f) std::swap(e, f);
      const auto& p = a_.topology.edges[e].vertices;
      const auto& q = a_.topology.edges[f].vertices;
      if (p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1]) return;
    }
    add_edge_contact(moving_a_, e, moving_b_, f, limits_, contacts_);
  }

  void add_vertices(std::vector<std::pair<int, int>>& pairs, const MovingSurface& x,
                    const MovingSurface& y) {
    std::sort(pairs.begin(), pairs.end());
    std::vector<int> triangles;
    for (std::size_t i = 0; i < pairs.size();) {
      const int vertex = pairs[i].first;
      triangles.clear();
      for (; i < pairs.size() && pairs[i].first == vertex; ++i)
        triangles.push_back(pairs[i].second);
      add_vertex_contacts(x, vertex, y, triangles.data(), triangles.data() + triangles.size(),
                          limits_, contacts_);
    }
  }

  const SweptSurface& a_;
  const SweptSurface& b_;
  const MovingSurface& moving_a_;
  const MovingSurface& moving_b_;
  ContactLimits limits_;
  bool self_;
  std::vector<std::pair<int, int>> vertices_of_a_, vertices_of_b_;  ///< with triangles of the other
  std::vector<Contact> contacts_;
};

/// Does the box reach the half space?
bool reaches(const BoundingBox& box, const CollisionPlane& plane) {
  double lowest = -plane.normal.dot(plane.point);
  for (int k = 0; k < 3; ++k)
    lowest += plane.normal[k] * (plane.normal[k] > 0 ? box.min[k] : box.max[k]);
  return lowest <= 0;
}

}  // namespace

struct CollisionDetector::State {
  std::vector<SweptSurface> surfaces;
  std::vector<char> prescribed, self_contact;
  std::vector<CollisionPlane> planes;
  CollisionOptions options;

  bool is_allowed(int a, int b) const {
    const auto& ignored = options.ignored_pairs;
    return std::find(ignored.begin(), ignored.end(), Pair(a, b)) == ignored.end() &&
           std::find(ignored.begin(), ignored.end(), Pair(b, a)) == ignored.end();
  }

  /// Every pair that may have contacts, first < second, sorted. Sweep along x.
  std::vector<Pair> close_pairs() const;
  std::vector<Contact> contacts(const Pair& pair, const std::vector<MovingSurface>& moving) const;
};

std::vector<Pair> CollisionDetector::State::close_pairs() const {
  const int count = static_cast<int>(surfaces.size());
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::make_pair(surfaces[a].box.min[0], a) < std::make_pair(surfaces[b].box.min[0], b);
  });
  std::vector<Pair> pairs;
  for (int i = 0; i < count; ++i) {
    const int a = order[i];
    if (self_contact[a]) pairs.emplace_back(a, a);
    for (int j = i + 1; j < count; ++j) {
      const int b = order[j];
      if (surfaces[b].box.min[0] > surfaces[a].box.max[0]) break;
      if (!(prescribed[a] && prescribed[b]) && overlap(surfaces[a].box, surfaces[b].box) &&
          is_allowed(a, b))
        pairs.emplace_back(std::min(a, b), std::max(a, b));
    }
    for (std::size_t p = 0; p < planes.size(); ++p)
      if (!prescribed[a] && reaches(surfaces[a].box, planes[p]) &&
          is_allowed(a, count + static_cast<int>(p)))
        pairs.emplace_back(a, count + static_cast<int>(p));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<Contact> CollisionDetector::State::contacts(
    const Pair& pair, const std::vector<MovingSurface>& moving) const {
  const auto [a, b] = pair;
  const int count = static_cast<int>(surfaces.size());
  if (b >= count) {
    std::vector<Contact> found;
    const CollisionPlane& plane = planes[b - count];
    add_plane_contacts(moving[a], b, plane.point, plane.normal, options, found);
    return found;
  }
  ContactLimits limits = options;
  // The other side of a thin wall is near, but nothing has come through it.
  if (a == b) limits.recovery_depth = limits.tolerance;
  return FeaturePairs(surfaces[a], moving[a], surfaces[b], moving[b], limits).contacts();
}

CollisionDetector::CollisionDetector(std::vector<CollisionSurface> surfaces,
                                     std::vector<CollisionPlane> planes, CollisionOptions options)
    : state_(std::make_unique<State>()) {
  state_->planes = std::move(planes);
  state_->options = std::move(options);
  state_->surfaces.resize(surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    state_->surfaces[i].topology = make_topology(surfaces[i].triangles, surfaces[i].vertex_count);
    state_->prescribed.push_back(surfaces[i].prescribed);
    state_->self_contact.push_back(surfaces[i].self_contact);
  }
}

CollisionDetector::~CollisionDetector() = default;
CollisionDetector::CollisionDetector(CollisionDetector&&) noexcept = default;
CollisionDetector& CollisionDetector::operator=(CollisionDetector&&) noexcept = default;

bool CollisionDetector::is_allowed(int a, int b) const {
  return state_->is_allowed(a, b);
}

std::vector<Contact> CollisionDetector::detect(const std::vector<SurfaceMotion>& motions) {
  State& state = *state_;
  require(motions.size() == state.surfaces.size(), "every surface has a motion");
  const double reach = std::max(state.options.margin, state.options.recovery_depth);
  std::vector<MovingSurface> moving;
  for (std::size_t i = 0; i < motions.size(); ++i)
    moving.push_back(
        {static_cast<int>(i), &state.surfaces[i].topology, motions[i].start, motions[i].end});
  parallel_for(motions.size(), [&](std::size_t i) { state.surfaces[i].sweep(motions[i], reach); });
  const std::vector<Pair> pairs = state.close_pairs();
  std::vector<char> used(motions.size(), 0);
  for (const auto& [a, b] : pairs)
    if (b < static_cast<int>(motions.size())) used[a] = used[b] = 1;
  parallel_for(motions.size(), [&](std::size_t i) {
    SweptSurface& surface = state.surfaces[i];
    if (used[i] && surface.refit)
      surface.tree->refit(surface.topology.triangles, surface.vertex_boxes);
    if (used[i]) surface.refit = false;
  });
  std::vector<std::vector<Contact>> found(pairs.size());
  parallel_for(pairs.size(), [&](std::size_t i) { found[i] = state.contacts(pairs[i], moving); });
  std::vector<Contact> contacts;
  for (const auto& part : found) contacts.insert(contacts.end(), part.begin(), part.end());
  std::sort(contacts.begin(), contacts.end(),
            [](const Contact& x, const Contact& y) { return x.key < y.key; });
  return contacts;
}

}  // namespace bem
