#pragma once

#include "mesh/triangle_mesh.hpp"

namespace bem {

/// Deformation gradients of a moving triangle surface at its vertices: means over the triangles T
/// around a vertex, weighted with their areas at rest,
///
///   F_i = sum |T| F_T / sum |T|,  F_T = t1' g1^T + t2' g2^T + n' n^T
///
/// of the gradients F_T that take two edges t1, t2 of a triangle to where they are, t1' and t2',
/// and its unit normal n to the unit normal n' (g1, g2: dual to t1, t2 in its plane). A rigid
/// motion of the surface has its rotation as gradient everywhere, up to rounding.
class SurfaceGradients {
 public:
  /// O(triangles). Triangles without area do not count.
  explicit SurfaceGradients(const TriangleMesh& rest);

  /// By vertex, the identity at those without triangles. O(triangles).
  std::vector<Mat3> at(const std::vector<Vec3>& positions) const;

 private:
  struct Basis {
    Vec3 g1, g2, normal;  ///< times the area
  };

  std::vector<Triangle> triangles_;
  std::vector<Basis> bases_;
  std::vector<double> areas_;  ///< around each vertex [m^2]
};

}  // namespace bem
