#pragma once

#include "mesh/bounding_box.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

namespace bem {

/// A triangle mesh as plain data: positions [m] and triangles of vertex indices. Nothing is
/// guaranteed about it; make_surface (mesh/surface.hpp) checks and orients one.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

/// The mesh with its coordinates multiplied.
inline TriangleMesh scaled(TriangleMesh mesh, const Vec3& scale) {
  for (Vec3& v : mesh.vertices) v = v.cwiseProduct(scale);
  return mesh;
}

inline std::array<Vec3, 3> triangle_corners(const TriangleMesh& mesh, const Triangle& t) {
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

/// Area [m^2] times unit normal of the triangle a, b, c (counter-clockwise seen from its tip).
inline Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 0.5 * (b - a).cross(c - a);
}

inline Vec3 area_vector(const TriangleMesh& mesh, const Triangle& t) {
  return area_vector(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
}

/// Area [m^2].
inline double triangle_area(const TriangleMesh& mesh, const Triangle& t) {
  return area_vector(mesh, t).norm();
}

/// Of all triangles [m^2].
inline double surface_area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) sum += triangle_area(mesh, t);
  return sum;
}

/// Unit normal; not finite for a triangle without area.
inline Vec3 triangle_normal(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3 v = area_vector(mesh, t);
  return v / v.norm();
}

inline Vec3 triangle_centroid(const TriangleMesh& mesh, const Triangle& t) {
  return (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
}

/// Length of the longest edge [m].
inline double longest_edge(const TriangleMesh& mesh, const Triangle& t) {
  double longest = 0;
  for (int k = 0; k < 3; ++k)
    longest = std::fmax(longest, (mesh.vertices[t[(k + 1) % 3]] - mesh.vertices[t[k]]).norm());
  return longest;
}

/// Smallest height over longest edge: 0.87 for an equilateral triangle, 0 for three points on a
/// line or at one place.
inline double height_ratio(const TriangleMesh& mesh, const Triangle& t) {
  const double edge = longest_edge(mesh, t);
  return edge > 0 ? 2.0 * triangle_area(mesh, t) / edge / edge : 0.0;
}

}  // namespace bem
