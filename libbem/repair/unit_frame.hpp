#pragma once

#include "mesh/triangle_mesh.hpp"

namespace bem {

/// Coordinates in which a mesh lies around the origin and its bounding box has a diagonal of 1, so
/// that lengths mean the same for meshes of any size.
struct UnitFrame {
  Vec3 centre = Vec3::Zero();  ///< [m]
  double size = 1;             ///< diagonal of the bounding box [m]; 1 for a single point

  TriangleMesh to_unit(TriangleMesh mesh) const;
  TriangleMesh from_unit(TriangleMesh mesh) const;
};

/// The frame of the vertices that triangles use. Finite coordinates required. O(n).
UnitFrame unit_frame(const TriangleMesh& mesh);

}  // namespace bem
