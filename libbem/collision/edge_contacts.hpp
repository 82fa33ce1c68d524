#pragma once

#include "collision/contact.hpp"
#include "collision/moving_surface.hpp"

#include <vector>

namespace bem {

/// Appends the contact of an edge of surface `a` with an edge of surface `b`, if there is one: both
/// are convex, their inner points are closest, and the direction between them is one in which
/// either edge is the outermost part of its surface. Flat and concave edges have no contacts: what
/// they would say is said by the vertices and triangles around them. `pressed`: they held each
/// other in the step before, and do so now however deep they are.
void add_edge_contact(const MovingSurface& a, int edge_a, const MovingSurface& b, int edge_b,
                      bool pressed, const ContactLimits& limits, std::vector<Contact>& contacts);

}  // namespace bem
