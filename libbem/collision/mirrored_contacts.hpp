#pragma once

#include "collision/contact.hpp"
#include "collision/moving_surface.hpp"

#include <vector>

namespace bem {

/// Where two vertices meet, either is in contact with a triangle at the other; both say the same
/// if their normals are opposite. Removes the one with the larger key from the contacts of two
/// surfaces. O(n log n).
void remove_mirrored(const ContactLimits& limits, const MovingSurface& a, const MovingSurface& b,
                     std::vector<Contact>& contacts);

}  // namespace bem
