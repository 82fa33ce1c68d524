#pragma once

#include "mesh/mass_properties.hpp"
#include "mesh/surface.hpp"

#include <optional>

namespace bem {

/// A body's surface as it is computed with: nodes in the order of recursive bisection, so that
/// clusters are ranges, triangles along a Hilbert curve, with the origin at the centre of mass.
struct BodyGeometry {
  TriangleMesh input;               ///< as read: outputs keep its vertices and faces
  std::vector<int> node_of_vertex;  ///< input vertex -> node, -1 if no triangle uses it
  std::vector<int> triangle_order;  ///< nodes.triangles[t] is input.triangles[triangle_order[t]]
  TriangleMesh nodes;               ///< relative to the centre of mass, outward
  MassProperties mass;              ///< centre in mesh coordinates
  double extent = 0;                ///< largest distance between two nodes [m]
  /// Tractions that hold a body or join it to others may jump along edges whose triangles' normals
  /// enclose more than this [deg].
  std::optional<double> corner_angle_deg;
};

/// O(n log n).
BodyGeometry make_geometry(const Surface& surface, double density);

/// The nodes' surface in the coordinates of the mesh.
TriangleMesh surface_at_rest(const BodyGeometry& geometry);

/// Checks a geometry that was read back as make_surface() and make_geometry() check and make one:
/// its mesh is a closed manifold, nodes and triangles are those of the input, and volume, mass,
/// inertia and extent are theirs. Throws ErrorCode::invalid_input as make_surface(). Indices are in
/// range. O(n log n).
void check_geometry(const BodyGeometry& geometry, double density, const std::string& source_name);

}  // namespace bem
