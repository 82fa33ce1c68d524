#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bem {

/// A body whose prescribed vertices turn against each other, as handles do that twist it, by more
/// than half a turn. All displacements of a body are measured in one frame, in which a surface that
/// has turned by half a turn against another part of it lies where it would lie had it turned the
/// other way: beyond that, forces do not bring vertices to their places any more.
struct Twist {
  std::size_t body = 0;  ///< index in the scene
  double since = 0;      ///< when it comes to half a turn [s]
  double angle = 0;      ///< the largest one until the end of the run [rad]
};

/// O(keyframes^2 of each body).
std::vector<Twist> find_twists(const Scene& scene, double duration);

/// Says what the twist is, why that cannot be, and what to do.
std::string twist_text(const Scene& scene, const Twist& twist);
/// The same in few words, for someone who has read that.
std::string short_twist_text(const Scene& scene, const Twist& twist);

}  // namespace bem
