#pragma once

#include "scene/json_reader.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <vector>

namespace bem {

/// One of the copies that "repeat" makes of a body or obstacle.
struct RepeatedCopy {
  std::string suffix;             ///< of the name: "-3", or "-1-0-2" in a lattice
  Vec3 offset = Vec3::Zero();     ///< [m], world axes
  std::optional<AxisAngle> turn;  ///< about the mesh's origin, world axes, after its rotation

  AxisAngle turned(const AxisAngle& rotation) const;
};

/// The copies that "repeat" asks for, at most 10000 (docs/scene-format.md, "Copies"). Jitter comes
/// from std::mt19937_64, whose numbers are the same everywhere: 53 bits of each number make one
/// that is uniform between -1 and 1. A copy takes three for its offset, then triples until one is
/// within the unit ball, which is the axis, then one for the angle. Throws
/// ErrorCode::invalid_input.
std::vector<RepeatedCopy> read_repeat(const JsonValue& value);

/// The things that the member "repeat" makes of `thing`: itself alone if there is none. Throws
/// ErrorCode::invalid_input if a name becomes too long.
std::vector<BodySpec> repeated(const BodySpec& body, const std::optional<JsonValue>& repeat);
std::vector<ObstacleSpec> repeated(const ObstacleSpec& obstacle,
                                   const std::optional<JsonValue>& repeat);

}  // namespace bem
