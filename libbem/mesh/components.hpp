#pragma once

#include "mesh/triangle_mesh.hpp"

#include <vector>

namespace bem {

/// A connected part of a closed surface.
struct Component {
  std::vector<int> triangles;  ///< ascending
  double volume = 0;           ///< enclosed volume [m^3], negative if the normals point inward
  double area = 0;             ///< [m^2]
  BoundingBox box;
  int depth = 0;    ///< number of other components around it: even = solid, odd = cavity
  int parent = -1;  ///< the innermost of these, -1 if there is none

  bool is_solid() const { return depth % 2 == 0; }
  /// Whether the normals point out of the material: away from what a solid encloses, into a cavity.
  bool faces_outward() const { return is_solid() == (volume > 0); }
};

/// Components of a closed manifold (check_closed_manifold) by shared edges, ordered by their first
/// triangle. O(n log n), and O(n) for every pair of components whose boxes overlap.
std::vector<Component> surface_components(const TriangleMesh& nodes);

/// Whether a closed surface encloses more than rounding, which leaves 1e-16 of area times size:
/// its volume [m^3], area [m^2] and size [m].
bool encloses_volume(double volume, double area, double size);

/// Turns the component's normals around: its triangles {a, b, c} become {a, c, b}.
void turn_over(TriangleMesh& nodes, Component& component);

}  // namespace bem
