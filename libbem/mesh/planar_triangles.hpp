#pragma once

#include "base/types.hpp"

#include <optional>
#include <vector>

namespace bem {

/// The constrained Delaunay triangulation of what a closed line around points of a plane encloses:
/// `loop` visits the points in counter-clockwise order, may visit one repeatedly, and may run along
/// a line twice in opposite directions, as a polygon with holes does that bridges connect to its
/// rim. Points that the loop does not enclose but for such a line become inner vertices. Each
/// triangle begins with its lowest index and is counter-clockwise; they are sorted.
///
/// Empty if the loop crosses itself, runs over a point between two of its own, or encloses a region
/// twice or clockwise. Points of the loop must differ. O(n log n) for ordinary polygons. CGAL's
/// exact predicates decide.
std::optional<std::vector<Triangle>> planar_triangles(const std::vector<Eigen::Vector2d>& points,
                                                      const std::vector<int>& loop);

}  // namespace bem
