#pragma once

#include "mesh/surface.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace bem {

/// What the checks of a body's surface say about a mesh.
struct Acceptance {
  std::optional<Surface> surface;  ///< if it is closed, a manifold and has a volume
  std::string refusal;             ///< why not
  std::size_t solids = 0;
  std::size_t crossings = 0;  ///< pairs of triangles that cut through each other

  bool closed() const { return surface.has_value(); }
  /// One solid that does not intersect itself.
  bool accepted() const { return solids == 1 && crossings == 0; }
};

/// O(n log n).
Acceptance check_acceptance(const TriangleMesh& mesh);

/// The triangles of an accepted surface facing outward.
TriangleMesh outward(const Acceptance& acceptance);

}  // namespace bem
