#include "constraints/joint_plan.hpp"

#include "base/error.hpp"
#include "collision/signed_distance.hpp"
#include "mesh/closest_points.hpp"
#include "mesh/corners.hpp"
#include "mesh/describe.hpp"
#include "scene/location.hpp"
#include "scene/selection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace bem {
namespace {

/// Mesh nodes of a body where they start in the world.
std::vector<Vec3> placed_nodes(const BodySpec& body, const BodyGeometry& g) {
  const Mat3 r = body.rotation.matrix();
  std::vector<Vec3> out;
  out.reserve(g.nodes.vertices.size());
  for (const Vec3& x : g.nodes.vertices) out.emplace_back(body.position + r * (x + g.mass.centre));
  return out;
}

Attachment node_attachment(int body, int node) {
  return {body, 1, {node, -1, -1}, {1, 0, 0}};
}

/// By vertex: the shortest of the edges around it [m].
std::vector<double> shortest_edges(const TriangleMesh& mesh) {
  std::vector<double> out(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      const double length = (mesh.vertices[a] - mesh.vertices[b]).norm();
      out[a] = std::min(out[a], length);
      out[b] = std::min(out[b], length);
    }
  return out;
}

/// Groups of nodes, over all bodies, that joints have already made one.
class NodeGroups {
 public:
  /// Returns false if the two were together before.
  bool unite(std::pair<int, int> a, std::pair<int, int> b) {
    const std::pair<int, int> x = find(a), y = find(b);
    if (x == y) return false;
    parent_[x] = y;
    return true;
  }

 private:
  std::pair<int, int> find(std::pair<int, int> node) {
    auto it = parent_.try_emplace(node, node).first;
    if (it->second == node) return node;
    return it->second = find(it->second);
  }
  std::map<std::pair<int, int>, std::pair<int, int>> parent_;
};

class Planner {
 public:
  Planner(const Scene& scene, const std::vector<const BodyGeometry*>& geometries)
      : scene_(scene), geometries_(geometries) {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      placed_.push_back(placed_nodes(scene.bodies[b], *geometries[b]));
  }

  JointPlan plan() {
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b) add_prescribed(static_cast<int>(b));
    for (const JointSpec& spec : scene_.joints) {
      if (spec.type == JointType::point)
        add_point(spec);
      else
        add_weld(spec);
    }
    plan_.nodes.resize(scene_.bodies.size());
    std::vector<std::map<int, bool>> nodes(scene_.bodies.size());
    for (const Joint& joint : plan_.joints)
      for (const Attachment* end : {&joint.a, &joint.b})
        for (int i = 0; i < end->count; ++i) {
          bool& anchored = nodes[end->body].try_emplace(end->nodes[i], false).first->second;
          anchored = anchored || joint.prescribed;
        }
    for (std::size_t b = 0; b < nodes.size(); ++b) {
      for (const auto& [node, anchored] : nodes[b]) plan_.nodes[b].push_back({node, anchored});
      if (geometries_[b]->corner_angle_deg) choose_triangles(*geometries_[b], plan_.nodes[b]);
    }
    return std::move(plan_);
  }

 private:
  void add_prescribed(int b) {
    const BodySpec& spec = scene_.bodies[b];
    std::map<int, const HandleSpec*> chosen;
    for (const Selection& s : spec.fixed)
      for (int node : select_nodes(*geometries_[b], s)) chosen[node] = nullptr;
    for (const HandleSpec& handle : spec.handles)
      for (int node : select_nodes(*geometries_[b], handle.select)) {
        const auto [entry, fresh] = chosen.try_emplace(node, &handle);
        if (!fresh && entry->second != &handle)
          throw error_at(handle.location,
                         "the handle moves a vertex that is already " +
                             std::string(entry->second ? "moved by another handle" : "fixed") +
                             "; select every vertex once");
      }
    for (const auto& [node, handle] : chosen) {
      Joint joint;
      joint.a = node_attachment(b, node);
      joint.prescribed = true;
      joint.handle = handle;
      joint.place = placed_[b][node];
      plan_.joints.push_back(joint);
      groups_.unite({b, node}, {-1, 0});
    }
  }

  /// At sharp edges tractions act on those sides that have a triangle all of whose corners are held
  /// or joined.
  static void choose_triangles(const BodyGeometry& g, std::vector<JointNode>& nodes) {
    const CornerSectors corners(g.nodes, *g.corner_angle_deg);
    std::vector<char> chosen(g.nodes.vertices.size(), 0);
    for (const JointNode& n : nodes) chosen[n.node] = 1;
    const auto is_whole = [&](int t) {
      const Triangle& triangle = g.nodes.triangles[t];
      return std::all_of(triangle.begin(), triangle.end(), [&](int v) { return chosen[v] != 0; });
    };
    for (JointNode& n : nodes) {
      const auto& sectors = corners.sectors(n.node);
      std::size_t taken = 0;
      for (const std::vector<int>& sector : sectors)
        if (std::any_of(sector.begin(), sector.end(), is_whole)) {
          n.triangles.insert(n.triangles.end(), sector.begin(), sector.end());
          ++taken;
        }
      if (taken == sectors.size()) n.triangles.clear();  // all of them
      std::sort(n.triangles.begin(), n.triangles.end());
    }
  }

  Attachment nearest_on_surface(const JointEnd& end) const {
    const BodyGeometry& g = *geometries_[end.body];
    const std::vector<Vec3>& x = placed_[end.body];
    double best = std::numeric_limits<double>::infinity();
    Attachment at;
    for (const Triangle& t : g.nodes.triangles) {
      const NearestPoint p = closest_on_triangle(end.point, x[t[0]], x[t[1]], x[t[2]]);
      const double distance = (p.point - end.point).norm();
      if (distance >= best) continue;
      best = distance;
      at = {static_cast<int>(end.body), 0, {-1, -1, -1}, {0, 0, 0}};
      for (int i = 0; i < 3; ++i)
        if (p.weights[i] > 0) {
          at.nodes[at.count] = t[i];
          at.weights[at.count++] = p.weights[i];
        }
    }
    if (best > JointTolerances::off_surface * g.extent)
      throw error_at(end.location, "the point is " + to_text(best) +
                                       " m away from the surface of body " +
                                       in_quotes(scene_.bodies[end.body].name) +
                                       "; choose a point on its surface");
    return at;
  }

  void add_point(const JointSpec& spec) {
    Joint joint;
    joint.a = nearest_on_surface(spec.a);
    const Vec3 a = joint.a.place(placed_[joint.a.body]);
    if (spec.b) {
      joint.b = nearest_on_surface(*spec.b);
      if ((spec.a.point - spec.b->point).norm() > spec.tolerance)
        throw error_at(spec.location, "the two points of the joint are " +
                                          to_text((spec.a.point - spec.b->point).norm()) +
                                          " m apart at the start, more than its tolerance of " +
                                          to_text(spec.tolerance) +
                                          " m; give both ends the same point");
      const Mat3 r = scene_.bodies[joint.a.body].rotation.matrix();
      joint.offset = r.transpose() * (joint.b.place(placed_[joint.b.body]) - a);
    } else {
      joint.place = a;
    }
    plan_.joints.push_back(joint);
  }

  void add_weld(const JointSpec& spec) {
    const int a = static_cast<int>(spec.a.body), b = static_cast<int>(spec.b->body);
    const Mat3 r = scene_.bodies[a].rotation.matrix();
    WeldPlan weld;
    weld.spec = &spec;
    std::vector<char> matched_a(placed_[a].size(), 0), matched_b(placed_[b].size(), 0);
    // sorted by x, so that only a thin slab has to be searched
    std::vector<int> order(placed_[b].size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](int i, int j) { return placed_[b][i][0] < placed_[b][j][0]; });
    for (std::size_t i = 0; i < placed_[a].size(); ++i) {
      const Vec3& x = placed_[a][i];
      int match = -1;
      double best = spec.tolerance;
      auto it = std::lower_bound(order.begin(), order.end(), x[0] - spec.tolerance,
                                 [&](int j, double value) { return placed_[b][j][0] < value; });
      for (; it != order.end() && placed_[b][*it][0] <= x[0] + spec.tolerance; ++it) {
        const double distance = (placed_[b][*it] - x).norm();
        if (distance > best) continue;
        best = distance;
        match = *it;
      }
      if (match < 0) continue;
      ++weld.joined;
      matched_a[i] = matched_b[match] = 1;
      const int node = static_cast<int>(i);
      if (!groups_.unite({a, node}, {b, match})) continue;  // follows from other joints
      Joint joint;
      joint.a = node_attachment(a, node);
      joint.b = node_attachment(b, match);
      joint.offset = r.transpose() * (placed_[b][match] - x);
      plan_.joints.push_back(joint);
    }
    add_unmatched(weld, a, matched_a, b);
    add_unmatched(weld, b, matched_b, a);
    if (weld.joined == 0)
      throw error_at(spec.location, "no vertex of body " + in_quotes(scene_.bodies[a].name) +
                                        " is within " + to_text(spec.tolerance) +
                                        " m of a vertex of body " +
                                        in_quotes(scene_.bodies[b].name) + " at the start; " +
                                        (weld.nearly > 0 ? nearly_text(weld) + "; " : "") +
                                        "place them together or raise the tolerance");
    plan_.welds.push_back(weld);
  }

  /// Looks for vertices of `body` that miss a vertex of `other` by little, or lie on its surface.
  void add_unmatched(WeldPlan& weld, int body, const std::vector<char>& matched, int other) const {
    const std::vector<Vec3>& x = placed_[body];
    const std::vector<double> edges = shortest_edges(geometries_[body]->nodes);
    const SignedDistance surface(geometries_[other]->nodes.triangles, placed_[other]);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (matched[i]) continue;
      const double reach = std::max(JointTolerances::nearly * edges[i], weld.spec->tolerance);
      if (std::abs(surface(x[i])) > reach) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vec3& y : placed_[other]) nearest = std::min(nearest, (y - x[i]).norm());
      if (nearest <= reach) {
        ++weld.nearly;
        weld.farthest = std::max(weld.farthest, nearest);
      } else if (std::abs(surface(x[i])) <=
                 std::max(JointTolerances::on_surface * edges[i], weld.spec->tolerance)) {
        ++weld.alone;
      }
    }
  }

  const Scene& scene_;
  const std::vector<const BodyGeometry*>& geometries_;
  std::vector<std::vector<Vec3>> placed_;  ///< nodes by body, in the world at the start
  NodeGroups groups_;
  JointPlan plan_;
};

}  // namespace

std::string nearly_text(const WeldPlan& weld) {
  return count_text(weld.nearly, "vertex") + (weld.nearly == 1 ? " misses" : " miss") +
         " a partner by up to " + rounded_text(weld.farthest, 2) + " m";
}

JointPlan plan_joints(const Scene& scene, const std::vector<const BodyGeometry*>& geometries) {
  return Planner(scene, geometries).plan();
}

}  // namespace bem
