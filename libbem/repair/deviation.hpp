#pragma once

#include "mesh/triangle_mesh.hpp"

namespace bem {

/// The closest points of two surfaces, as far as vertices of the first find them.
struct Approach {
  Vec3 from = Vec3::Zero();  ///< a vertex of the first surface
  Vec3 to = Vec3::Zero();    ///< a point of the second one

  double distance() const { return (to - from).norm(); }
};

/// The largest distance [m] of a vertex or the centre of a triangle of `mesh` from the surface of
/// `other`, which has triangles. O(n log n).
double deviation(const TriangleMesh& mesh, const TriangleMesh& other);

/// The larger of the deviations of two surfaces from each other [m]. O(n log n).
double distance_between(const TriangleMesh& a, const TriangleMesh& b);

/// Both meshes have triangles; vertices that no triangle uses do not count. O(n log n).
Approach closest_approach(const TriangleMesh& mesh, const TriangleMesh& other);

}  // namespace bem
