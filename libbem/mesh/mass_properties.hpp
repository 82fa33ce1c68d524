#pragma once

#include "mesh/triangle_mesh.hpp"

#include <vector>

namespace bem {

/// Of a homogeneous body in the axes of its mesh.
struct MassProperties {
  double volume = 0;            ///< [m^3]
  double mass = 0;              ///< [kg]
  Vec3 centre = Vec3::Zero();   ///< centre of mass [m]
  Mat3 inertia = Mat3::Zero();  ///< about the centre of mass [kg m^2]
};

/// Exact for the polyhedron with outward triangles (M44); `density` in kg/m^3. O(n).
MassProperties mass_properties(const TriangleMesh& mesh, double density);

/// A_i = int phi_i dGamma [m^2], phi_i the linear hat function of vertex i: a third of the area of
/// its triangles. A nodal force f_i is the nodal traction f_i / A_i. O(n).
std::vector<double> vertex_areas(const TriangleMesh& mesh);

/// Shape-matching weights w_i = int ((y - centre) . n) phi_i dGamma [m^3]; their sum is three times
/// the volume. They can be negative on strongly nonconvex bodies. O(n).
std::vector<double> volume_weights(const TriangleMesh& mesh, const Vec3& centre);

/// W_i = int (y - centre) n^T phi_i dGamma [m^3] (first three rows of (M52)): to first order,
/// displacements u_i move the centroid of the enclosed volume V by (1/V) sum_i W_i u_i if `centre`
/// is that centroid. trace W_i = w_i. O(n).
std::vector<Mat3> volume_centroid_weights(const TriangleMesh& mesh, const Vec3& centre);

}  // namespace bem
