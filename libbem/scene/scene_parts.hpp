#pragma once

#include "scene/json_reader.hpp"
#include "scene/scene.hpp"

#include <map>
#include <string>

// The pieces of parse_scene(). Each reads one JSON value of the scene file and throws
// ErrorCode::invalid_input for whatever is wrong with it.

namespace bem {

inline constexpr std::size_t kMaxNameBytes = 200;  // a file name has at most 255, suffix included

/// A name of a body or obstacle: fit to be part of a file name and of an HDF5 path.
std::string read_name(const JsonValue& value);

/// A path, resolved against the folder of the document's file.
FilePath read_path(const JsonValue& value);

/// {"axis": [x, y, z], "angle_deg": a}
AxisAngle read_rotation(const JsonValue& value);

/// "all", {"vertices": [...]}, {"triangles": [...]} or {"box": ...} with an optional normal.
Selection read_selection(const JsonValue& value);

/// Keyframes with increasing times; "about" is inherited from the keyframe before.
Motion read_motion(const JsonValue& value);

/// [[time, factor], ...] with increasing times.
Profile read_profile(const JsonValue& value);

/// Where a body or obstacle of some name is in the scene's list.
using ThingNames = std::map<std::string, std::size_t>;

/// The index of the thing with this name, which stands at `place`; `what` describes it in messages:
/// "a body".
std::size_t thing_named(const std::string& name, const Location& place, const ThingNames& things,
                        const std::string& what);

/// A body or an obstacle, or what "repeat" makes of it.
std::vector<BodySpec> read_bodies(const JsonValue& value);
std::vector<ObstacleSpec> read_obstacles(const JsonValue& value);
JointSpec read_joint(const JsonValue& value, const ThingNames& bodies);
ContactSpec read_contact(const JsonValue& value);
OutputSpec read_output(const JsonValue& value);
InitialStateSpec read_initial_state(const JsonValue& value, const ThingNames& bodies);

}  // namespace bem
