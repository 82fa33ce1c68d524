#include "collision/moving_surface.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace bem {
namespace {

constexpr double kFacing = 0.2;      ///< a vertex faces n if n . (its normal) < -kFacing
constexpr double kTipSlack = 0.05;   ///< sine of the angle by which a neighbour may lie deeper
constexpr double kArcSlack = 0.1;    ///< of the arc's angle
constexpr double kMostSlack = 0.02;  ///< [rad]

Vec3 unit(const Vec3& v) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

/// Is edge k of triangle i of the fans one without a second triangle?
bool is_rim(const SurfaceTopology& topology, int i, int k) {
  const int edge = topology.triangle_edges[topology.fan_triangles[i]][k];
  return topology.edges[edge].triangles[1] < 0;
}

}  // namespace

Vec3 unit_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  return unit((b - a).cross(c - a));
}

Vec3 triangle_normal(const MovingSurface& surface, int triangle, double t) {
  if (surface.normals && t == 0) return surface.normals->start[triangle];
  if (surface.normals && t == 1) return surface.normals->end[triangle];
  const auto [a, b, c] = surface.triangle(triangle, t);
  return unit_normal(a, b, c);
}

Vec3 vertex_normal(const MovingSurface& surface, int vertex, double t) {
  const SurfaceTopology& topology = *surface.topology;
  const Vec3 at = surface.vertex(vertex, t);
  Vec3 sum = Vec3::Zero();
  for (int i = topology.fan_begin[vertex]; i < topology.fan_begin[vertex + 1]; ++i) {
    const Triangle& c = topology.triangles[topology.fan_triangles[i]];
    const int k = c[0] == vertex ? 0 : c[1] == vertex ? 1 : 2;
    const Vec3 p = surface.vertex(c[(k + 1) % 3], t) - at;
    const Vec3 q = surface.vertex(c[(k + 2) % 3], t) - at;
    const Vec3 normal = p.cross(q);
    const double sine = normal.norm();
    if (sine == 0) continue;
    sum += std::atan2(sine, p.dot(q)) / sine * normal;
    // At a rim the surface turns by a right angle, from the triangle to outward along the sheet.
    if (is_rim(topology, i, k)) sum += kPi / 2 * unit(p.cross(normal));
    if (is_rim(topology, i, (k + 2) % 3)) sum += kPi / 2 * unit(normal.cross(q));
  }
  return unit(sum);
}

Vec3 edge_normal(const MovingSurface& surface, int edge, double t) {
  const auto& triangles = surface.topology->edges[edge].triangles;
  Vec3 sum = triangle_normal(surface, triangles[0], t);
  if (triangles[1] >= 0) sum += triangle_normal(surface, triangles[1], t);
  return sum;
}

bool NormalArc::contains(const Vec3& direction) const {
  const double slack = std::min(kMostSlack, kArcSlack * angle);
  return first.cross(direction).dot(edge) >= -slack &&
         direction.cross(second).dot(edge) >= -slack && direction.dot(first + second) > 0;
}

NormalArc normal_arc(const MovingSurface& surface, int edge, double t) {
  const SurfaceTopology::Edge& e = surface.topology->edges[edge];
  NormalArc arc;
  arc.edge = unit(surface.vertex(e.vertices[1], t) - surface.vertex(e.vertices[0], t));
  arc.first = triangle_normal(surface, e.triangles[0], t);
  arc.second = e.triangles[1] >= 0 ? triangle_normal(surface, e.triangles[1], t)
                                   : Vec3(arc.edge.cross(arc.first));
  arc.angle = std::atan2(arc.first.cross(arc.second).dot(arc.edge), arc.first.dot(arc.second));
  return arc;
}

TrianglePlace place_at_triangle(const Vec3& point, const MovingSurface& surface, int triangle,
                                double t) {
  const auto [p, q, r] = surface.triangle(triangle, t);
  TrianglePlace place;
  place.closest = closest_on_triangle(point, p, q, r);
  place.normal = triangle_normal(surface, triangle, t);
  const Vec3 between = point - place.closest.point;
  place.height = place.normal.dot(between);
  place.overhang = (between - place.height * place.normal).norm();
  return place;
}

bool is_tip(const MovingSurface& surface, int vertex, double t, const Vec3& n) {
  const SurfaceTopology& topology = *surface.topology;
  const Vec3 at = surface.vertex(vertex, t);
  for (int i = topology.fan_begin[vertex]; i < topology.fan_begin[vertex + 1]; ++i) {
    for (int v : topology.triangles[topology.fan_triangles[i]]) {
      const Vec3 d = surface.vertex(v, t) - at;
      if (n.dot(d) < -kTipSlack * d.norm()) return false;
    }
  }
  return n.dot(vertex_normal(surface, vertex, t)) < 0;
}

bool faces(const MovingSurface& surface, int vertex, double t, const Vec3& n) {
  return n.dot(vertex_normal(surface, vertex, t)) < -kFacing || is_tip(surface, vertex, t, n);
}

}  // namespace bem
