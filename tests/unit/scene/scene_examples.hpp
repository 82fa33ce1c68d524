#pragma once

#include "base/error.hpp"
#include "scene/scene_json.hpp"

#include <string>

namespace bem::test {

/// A scene that uses every key of the format.
inline const std::string& full_scene() {
  static const std::string text = R"json({ "version": 1,
  "time_step": 0.003, "duration": 1.5,
  "gravity": [0, -9.81, 0],
  "bodies": [
    { "name": "bunny", "archive": "bunny.bem", "render_mesh": "bunny-uv.obj", "include": [],
      "groups": {"ears": {"sphere": {"center": [0,1,0], "radius": 0.2}},
                 "back": {"plane": {"point": [0,0,1], "normal": [0,0,2]}, "normal": [0,0,1]}},
      "position": [0, 0.3, 0], "rotation": {"axis": [0, 2, 0], "angle_deg": 30},
      "velocity": [1.5, 0, 0], "angular_velocity": [0, 0, 4],
      "frame": "moving", "correction": "least_squares", "centrifugal": false,
      "gravity": true,
      "friction": 0.4,
      "fixed":   [ {"vertices": [0, 1, 2]}, {"box": {"min": [0,0,0], "max": [0.01,1,1]}} ],
      "handles": [ {"select": {"box": {"min": [0,0,0], "max": [1,2,3]}},
                    "motion": [ {"time": 0, "translate": [0,0,0], "rotate": {"axis": [1,0,0], "angle_deg": 0}, "about": [0,0,7]},
                                {"time": 2, "translate": [0,1,0]} ],
                    "release_time": 0.5} ],
      "tractions": [ {"select": {"box": {"min": [0,0,0], "max": [1,1,1]}, "normal": [5,0,0], "normal_tolerance_deg": 60},
                      "traction": [900, 0, 0], "profile": [[0, 1], [0.1, 3]], "follow": true},
                     {"select": "all", "pressure": 1000},
                     {"select": {"triangles": [7]}, "pressure": -1, "follow": true},
                     {"select": {"group": "ears"}, "pressure": 5} ] },
    { "name": "left", "archive": "/archives/rod.bem", "frame": "static", "gravity": false,
      "place": {"center": [0,5,0], "on": "bowl", "gap": 0.25, "direction": [0,-2,0]} },
    { "name": "right", "archive": "../rod.bem" },
    { "name": "brick", "archive": "brick.bem",
      "repeat": {"count": [2,1,2], "spacing": [1,2,3], "jitter": {"position": 0.01, "rotation_deg": 5, "seed": 3}} },
    { "name": "soft", "mesh": "toy.obj", "mesh_scale": 0.001, "precompute": {"scheme": "radau3", "codec_tol": 1e-3, "measure_growth": true},
      "material": {"name": "jelly", "density": 1000, "youngs_modulus": 3e4, "poisson_ratio": 0.5} },
    { "name": "firm", "mesh": "toy.obj", "material": {"name": "rubber", "density": 1100, "shear_modulus": 1e6, "poisson_ratio": 0.49} } ],
  "obstacles": [ {"name": "floor", "plane": {"point": [0,1,0], "normal": [0,3,0]}, "friction": 0.4},
                 {"name": "bowl", "mesh": "bowl.obj", "scale": [1,2,3], "position": [0,0,9], "rotation": {"axis": [0,0,1], "angle_deg": 90}, "friction": 0.3, "motion": []},
                 {"name": "post", "mesh": "post.obj", "repeat": {"count": 3, "spacing": [1,0,0]}} ],
  "joints": [ {"type": "point", "a": {"body": "left", "point": [0.1,0,0]}, "b": {"body": "right", "point": [0.2,0,0]}},
              {"type": "weld", "a": {"body": "left"}, "b": {"body": "right"}, "tolerance": 1e-3} ],
  "contact": {"enabled": true, "self": false, "tolerance": 1e-5, "friction_combine": "average", "solver": "nsgs"},
  "output": {"formats": ["hdf5", "obj"], "every": 3, "fields": ["positions", "tractions"], "surface": "both"},
  "initial_state": {"trajectory": "runs/drop.h5", "frame": -3, "bodies": ["soft", "left"]},
  "include": [],
  "defaults": {"body": {"friction": 0.6}, "obstacle": {"friction": 0.7}} })json";
  return text;
}

/// A scene with one body whose object ends with `members` (JSON, with a leading comma); they stand
/// in line 4.
inline std::string scene_with_body(const std::string& members) {
  return "{\"version\": 1, \"time_step\": 0.01, \"duration\": 1,\n\"bodies\": [\n"
         "{\"name\": \"a\", \"archive\": \"a.bem\"\n" +
         members + "\n}]}";
}

/// The smallest scene, with `members` (JSON, with a leading comma) in line 2.
inline std::string scene_with(const std::string& members) {
  return "{\"version\": 1, \"time_step\": 0.01, \"duration\": 1, "
         "\"bodies\": [{\"name\": \"a\", \"archive\": \"a.bem\"}]\n" +
         members + "\n}";
}

/// The message that `read` fails with; "" if it succeeds, and the wrong code if that is not
/// ErrorCode::invalid_input.
template <class Read>
std::string message_of(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::invalid_input)
      return "error code " + std::to_string(static_cast<int>(error.code()));
    return error.what();
  }
  return "";
}

inline std::string scene_error(const std::string& text) {
  return message_of([&] { parse_scene("s.json", text); });
}

}  // namespace bem::test
