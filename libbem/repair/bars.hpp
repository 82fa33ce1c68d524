#pragma once

#include "mesh/surface.hpp"

#include <cstddef>

namespace bem {

/// Bars that join the solids of a surface.
struct Bars {
  TriangleMesh mesh;  ///< a closed prism for each bar; the ends lie a width inside the solids
  std::size_t count = 0;
  double longest = 0;  ///< largest distance that a bar spans [m]
};

/// Bars of the given width [m] between the closest points of solids, always between the joined
/// ones and the solid that is nearest to them. O(k^2 n log n) for k solids.
Bars joining_bars(const Surface& surface, double width);

}  // namespace bem
