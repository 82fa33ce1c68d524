#pragma once

#include "mesh/triangle_mesh.hpp"

#include <string>
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
};

/// How often the triangles wind around `point`: 1 inside and 0 outside of a closed surface with
/// outward normals, -1 inside one with inward normals, anything between on the surface.
/// O(triangles). Solid angle of one triangle after van Oosterom and Strackee (1983).
double winding_number(const TriangleMesh& mesh, const std::vector<int>& triangles,
                      const Vec3& point);

/// Components of a closed manifold (check_closed_manifold) by shared edges, ordered by their first
/// triangle. O(n log n), and O(n) for every pair of components whose boxes overlap.
std::vector<Component> surface_components(const TriangleMesh& nodes);

/// Turns the surface outward in place: components at even depth get positive volume, cavities
/// negative (triangles {a, b, c} become {a, c, b}), with a warning about those that were turned.
/// `input` gives the indices for messages. Throws ErrorCode::invalid_input if a component encloses
/// no volume.
void orient_outward(const TriangleMesh& input, TriangleMesh& nodes, const std::string& source,
                    std::vector<std::string>& warnings);

}  // namespace bem
