#pragma once

#include "collision/surface_topology.hpp"
#include "mesh/closest_points.hpp"

#include <array>

namespace bem {

/// Unit normals of all triangles of a surface.
struct SurfaceNormals {
  std::vector<Vec3> start, end;
};

/// A surface in a step whose vertices move on straight lines; t in [0, 1] is the time.
struct MovingSurface {
  int index = -1;
  const SurfaceTopology* topology = nullptr;
  const std::vector<Vec3>* start = nullptr;
  const std::vector<Vec3>* end = nullptr;
  const SurfaceNormals* normals = nullptr;  ///< if they are known already

  Vec3 vertex(int v, double t) const {
    if (t == 0) return (*start)[v];
    if (t == 1) return (*end)[v];
    return (*start)[v] + t * ((*end)[v] - (*start)[v]);
  }
  Vec3 change(int v) const { return (*end)[v] - (*start)[v]; }

  std::array<Vec3, 3> triangle(int triangle, double t) const {
    const Triangle& c = topology->triangles[triangle];
    return {vertex(c[0], t), vertex(c[1], t), vertex(c[2], t)};
  }
};

/// Unit normal of the triangle a, b, c; zero if it has no area.
Vec3 unit_normal(const Vec3& a, const Vec3& b, const Vec3& c);

/// Unit normal of a triangle at time t; zero for a triangle without area.
Vec3 triangle_normal(const MovingSurface& surface, int triangle, double t);

/// Unit pseudonormal of a vertex: normals of its triangles weighted by their angles, and at a rim
/// the outward direction along the sheet weighted by a right angle. With the
/// normals of triangles and the sum of both at an edge, it tells inside from outside (Baerentzen &
/// Aanaes 2005).
Vec3 vertex_normal(const MovingSurface& surface, int vertex, double t);

/// Sum of the normals of the triangles at an edge, not normalised.
Vec3 edge_normal(const MovingSurface& surface, int edge, double t);

/// The directions in which the surface's edge is its locally outermost part: an arc from one
/// triangle's normal to the other's about the edge. At a boundary it ends along the sheet.
struct NormalArc {
  Vec3 edge;           ///< unit vector
  Vec3 first, second;  ///< unit vectors, counter-clockwise about `edge`
  double angle = 0;    ///< from first to second [rad]; not positive at flat and concave edges

  /// Is the unit vector within the arc, widened by a tenth (at most 0.02 rad) at either end?
  bool contains(const Vec3& direction) const;
};

NormalArc normal_arc(const MovingSurface& surface, int edge, double t);

/// A point and a triangle at one time.
struct TrianglePlace {
  NearestPoint closest;  ///< of the triangle
  Vec3 normal;           ///< of the triangle
  double height = 0;     ///< of the point above the triangle's plane [m]
  double overhang = 0;   ///< how far its foot on the plane lies outside the triangle [m]
};

TrianglePlace place_at_triangle(const Vec3& point, const MovingSurface& surface, int triangle,
                                double t);

/// Is the vertex a tip against unit vector n: no neighbour lies deeper along -n by more than an
/// angle of 0.05 rad, and its normal points that way?
bool is_tip(const MovingSurface& surface, int vertex, double t, const Vec3& n);

/// May the vertex be pushed along n: does its surface face the other way, or is it a tip?
bool faces(const MovingSurface& surface, int vertex, double t, const Vec3& n);

}  // namespace bem
