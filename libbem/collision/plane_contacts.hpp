#pragma once

#include "collision/contact.hpp"
#include "collision/moving_surface.hpp"

#include <vector>

namespace bem {

/// Appends the contacts of all vertices of a surface that end the step nearer to the half space
/// below a plane than the margin. O(n).
void add_plane_contacts(const MovingSurface& a, int plane_index, const Vec3& point,
                        const Vec3& normal, const ContactLimits& limits,
                        std::vector<Contact>& contacts);

}  // namespace bem
