#pragma once

#include "collision/contact.hpp"
#include "collision/moving_surface.hpp"

#include <vector>

namespace bem {

/// Appends the contacts of one vertex of surface `a` with the triangles [first, last) of surface
/// `b`, ascending, which are all that come near it during the step. A vertex that enters the
/// surface (it touches at the start, or goes through a triangle from outside) is held by the
/// triangle under its end, one that only comes near by the triangles it ends above. More than one
/// triangle holds it only where they enclose it like the walls of a corner.
/// `pressed`: the triangle of b that held the vertex in the step before, if it is deeper below it
/// now than the recovery depth; else -1. Such a vertex is still held from that side.
void add_vertex_contacts(const MovingSurface& a, int vertex, const MovingSurface& b,
                         const int* first, const int* last, int pressed,
                         const ContactLimits& limits, std::vector<Contact>& contacts);

}  // namespace bem
