#pragma once

#include "mesh/components.hpp"

#include <string>
#include <vector>

namespace bem {

/// A checked closed surface: what the file said, and the mesh that is computed with.
struct Surface {
  TriangleMesh input;               ///< as read: outputs keep its vertices and faces
  std::vector<int> node_of_vertex;  ///< input vertex -> node, -1 if no triangle uses the vertex
  TriangleMesh nodes;               ///< unique positions; triangles[t] is input's t, facing outward
  std::vector<Component> components;  ///< of nodes
  std::vector<std::string> warnings;
};

/// Welds vertices of exactly equal position, checks that the result is a closed, manifold and
/// consistently oriented surface around a volume, and turns it outward. Nodes come in the order of
/// the input vertices. Throws ErrorCode::invalid_input with a message that names `source_name`, the
/// first bad element and how many there are (mesh/validate.hpp). O(n log n), about 0.3 s for 10^5
/// triangles.
Surface make_surface(TriangleMesh input, const std::string& source_name);

}  // namespace bem
