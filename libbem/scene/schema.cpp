#include "scene/schema.hpp"

#include "base/error.hpp"
#include "scene/scene.hpp"

namespace bem {
namespace {

/// Puts names in place of that of their kind: "enum": "T" becomes "enum": ["a", "b"].
void list_names(std::string& schema, const std::string& kind,
                const std::vector<std::string>& choices) {
  const std::string mark = "\"enum\": \"" + kind + "\"";
  std::string names;
  for (const std::string& name : choices) names += (names.empty() ? "\"" : ", \"") + name + "\"";
  const std::size_t at = schema.find(mark);
  require(at != std::string::npos, "the schema has every enumeration of scenes");
  schema.replace(at, mark.size(), "\"enum\": [" + names + "]");
}

const char* type_of(Setting::Kind kind) {
  switch (kind) {
    case Setting::Kind::number:
      return R"("number")";
    case Setting::Kind::integer:
      return R"("integer")";
    case Setting::Kind::flag:
      return R"("boolean")";
    case Setting::Kind::text:
      return R"(["string", "number"])";
  }
  return "";
}

/// Puts the settings in place of their mark.
void list_settings(std::string& schema) {
  const std::string mark = "\"settings\"";
  std::string members;
  for (const Setting& setting : precompute_settings())
    if (setting.in_scenes)
      members += (members.empty() ? "" : ",") + std::string("\n        \"") + setting.key() +
                 "\": {\"description\": \"" + setting.help +
                 "\", \"type\": " + type_of(setting.kind) + "}";
  const std::size_t at = schema.find(mark);
  require(at != std::string::npos, "the schema has the settings");
  schema.replace(at, mark.size(), "{" + members + "\n      }");
}

std::string with_names(std::string schema) {
  list_settings(schema);
  list_names(schema, "FrameMotion", choice_names<FrameMotion>());
  list_names(schema, "Correction", choice_names<Correction>());
  list_names(schema, "FrictionCombine", choice_names<FrictionCombine>());
  list_names(schema, "FrictionMethod", choice_names<FrictionMethod>());
  list_names(schema, "OutputFormat", output_format_names());
  list_names(schema, "OutputField", choice_names<OutputField>());
  list_names(schema, "OutputSurface", choice_names<OutputSurface>());
  return schema;
}

}  // namespace

const std::string& scene_schema() {
  static const std::string schema = with_names(R"json({
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "title": "Scene of bemsim, version 1",
  "description": "SI units. Angles are in degrees where the key says so. Paths are relative to the scene file.",
  "type": "object",
  "required": ["version", "duration", "bodies"],
  "additionalProperties": false,
  "properties": {
    "version": {"description": "Version of this format.", "const": 1},
    "time_step": {
      "description": "Time step [s]; that of every archive of the scene. auto: that of the archives, else from the speed of waves and the edges of the meshes; default auto.",
      "oneOf": [{"type": "number", "exclusiveMinimum": 0}, {"const": "auto"}]
    },
    "duration": {"description": "Simulated time [s].", "type": "number", "minimum": 0},
    "gravity": {"description": "Acceleration of gravity [m/s^2]; default [0, 0, 0].", "$ref": "#/$defs/vec3"},
    "bodies": {"type": "array", "minItems": 1, "items": {"$ref": "#/$defs/body"}},
    "obstacles": {"description": "Rigid surroundings; default none.", "type": "array", "items": {"$ref": "#/$defs/obstacle"}},
    "joints": {"description": "Connections of bodies; default none.", "type": "array", "items": {"$ref": "#/$defs/joint"}},
    "contact": {"$ref": "#/$defs/contact"},
    "output": {"$ref": "#/$defs/output"}
  },
  "$defs": {
    "vec3": {"description": "[x, y, z]", "type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3},
    "name": {
      "description": "Name of a body or obstacle, used once in the scene and fit for file names: at most 200 bytes, no '/', no control characters.",
      "type": "string", "maxLength": 200, "pattern": "^[^/\\u0000-\\u001f\\u007f]+$", "not": {"enum": [".", ".."]}
    },
    "path": {"description": "Path of a file, relative to the scene file.", "type": "string", "minLength": 1, "pattern": "^[^\\u0000]+$"},
    "friction": {"description": "Coefficient of friction; default 0.", "type": "number", "minimum": 0},
    "scale": {
      "description": "Factor of the mesh's coordinates, one for all axes or one for each; default 1.",
      "oneOf": [
        {"type": "number", "exclusiveMinimum": 0},
        {"type": "array", "items": {"type": "number", "exclusiveMinimum": 0}, "minItems": 3, "maxItems": 3}
      ]
    },
    "rotation": {
      "description": "Rotation about an axis through the origin.",
      "type": "object", "required": ["axis", "angle_deg"], "additionalProperties": false,
      "properties": {
        "axis": {"description": "Direction of any length but zero.", "$ref": "#/$defs/vec3"},
        "angle_deg": {"description": "Angle [degrees], counter-clockwise seen against the axis.", "type": "number"}
      }
    },
    "indices": {"description": "0-based indices.", "type": "array", "minItems": 1, "items": {"type": "integer", "minimum": 0, "maximum": 2147483647}},
    "box": {
      "description": "Axis-parallel box in mesh coordinates [m].",
      "type": "object", "required": ["min", "max"], "additionalProperties": false,
      "properties": {
        "min": {"description": "Lower corner [m].", "$ref": "#/$defs/vec3"},
        "max": {"description": "Upper corner [m].", "$ref": "#/$defs/vec3"}
      }
    },
    "selection": {
      "description": "Chooses vertices or triangles of the body's mesh.",
      "oneOf": [
        {"description": "The whole surface.", "const": "all"},
        {
          "type": "object", "required": ["vertices"], "additionalProperties": false,
          "properties": {"vertices": {"description": "Vertices.", "$ref": "#/$defs/indices"}}
        },
        {
          "type": "object", "required": ["triangles"], "additionalProperties": false,
          "properties": {"triangles": {"description": "Triangles.", "$ref": "#/$defs/indices"}}
        },
        {
          "type": "object", "required": ["box"], "additionalProperties": false,
          "dependentRequired": {"normal_tolerance_deg": ["normal"]},
          "properties": {
            "box": {"$ref": "#/$defs/box"},
            "normal": {"description": "Only triangles whose outward normal is near this direction (mesh coordinates).", "$ref": "#/$defs/vec3"},
            "normal_tolerance_deg": {"description": "Largest angle between the two [degrees]; default 30.", "type": "number", "minimum": 0, "maximum": 180}
          }
        }
      ]
    },
    "motion": {
      "description": "Keyframes with increasing times; linear in between, constant before the first and after the last.",
      "type": "array",
      "items": {
        "type": "object", "required": ["time"], "additionalProperties": false,
        "properties": {
          "time": {"description": "Time [s].", "type": "number"},
          "translate": {"description": "Displacement [m], world axes; default [0, 0, 0].", "$ref": "#/$defs/vec3"},
          "rotate": {"description": "Rotation, world axes; default none.", "$ref": "#/$defs/rotation"},
          "about": {"description": "Centre of the rotation [m], world coordinates; default that of the keyframe before, [0, 0, 0] in the first.", "$ref": "#/$defs/vec3"}
        }
      }
    },
    "profile": {
      "description": "Factor over time, [[time [s], factor], ...] with increasing times: linear in between, constant before the first and after the last.",
      "type": "array", "minItems": 1,
      "items": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}
    },
    "handle": {
      "type": "object", "required": ["select"], "additionalProperties": false,
      "properties": {
        "select": {"$ref": "#/$defs/selection"},
        "motion": {"description": "Moves the vertices away from their initial world positions; default none: they are held.", "$ref": "#/$defs/motion"},
        "release_time": {"description": "The vertices are free after this time [s]; default never.", "type": "number", "minimum": 0}
      }
    },
    "traction": {
      "type": "object", "required": ["select"], "additionalProperties": false,
      "properties": {
        "select": {"$ref": "#/$defs/selection"},
        "traction": {"description": "Force per area of the undeformed surface [Pa], world axes.", "$ref": "#/$defs/vec3"},
        "pressure": {"description": "Pressure [Pa], against the outward normal; it turns with the body's frame.", "type": "number"},
        "profile": {"$ref": "#/$defs/profile"},
        "follow": {"description": "Whether the load turns with the body's frame; default false for a traction, always true for a pressure.", "type": "boolean"}
      },
      "oneOf": [
        {"required": ["traction"]},
        {"required": ["pressure"], "properties": {"follow": {"const": true}}}
      ]
    },
    "body": {
      "type": "object", "required": ["name"], "additionalProperties": false,
      "anyOf": [{"required": ["mesh", "material"]}, {"required": ["archive"], "not": {"required": ["precompute"]}}],
      "dependentRequired": {"mesh": ["material"], "material": ["mesh"], "mesh_scale": ["mesh"], "precompute": ["mesh"]},
      "properties": {
        "name": {"$ref": "#/$defs/name"},
        "mesh": {"description": "Closed mesh of the body, from which its matrices are computed where there is no archive.", "$ref": "#/$defs/path"},
        "material": {"description": "Material of the body.", "oneOf": [{"$ref": "#/$defs/path"}, {"$ref": "#/$defs/material"}]},
        "mesh_scale": {"description": "Factor on the coordinates of the mesh; default 1.", "type": "number", "exclusiveMinimum": 0},
        "precompute": {"$ref": "#/$defs/precompute"},
        "archive": {"description": "Matrix archive written by bemprecomp.", "$ref": "#/$defs/path"},
        "render_mesh": {"description": "Mesh that trajectories show in place of the simulated surface, which moves it; default none.", "$ref": "#/$defs/path"},
        "position": {"description": "World position of the mesh's origin [m]; default [0, 0, 0].", "$ref": "#/$defs/vec3"},
        "rotation": {"description": "World = position + R * mesh coordinates; default none.", "$ref": "#/$defs/rotation"},
        "velocity": {"description": "Of the centre of mass [m/s]; default [0, 0, 0].", "$ref": "#/$defs/vec3"},
        "angular_velocity": {"description": "About the centre of mass [rad/s], world axes; default [0, 0, 0].", "$ref": "#/$defs/vec3"},
        "frame": {"description": "Frame of the displacements; default moving.", "enum": "FrameMotion"},
        "correction": {"description": "What keeps displacements free of rigid motion: the linear projection, or the paper's least squares, to compare with; default projection.", "enum": "Correction"},
        "gravity": {"description": "Whether gravity acts on the body; default true.", "type": "boolean"},
        "centrifugal": {"description": "Whether its rotation deforms the body: gyroscopic and centrifugal forces of a moving frame; default true.", "type": "boolean"},
        "friction": {"$ref": "#/$defs/friction"},
        "fixed": {"description": "Vertices that stay where they are.", "type": "array", "items": {"$ref": "#/$defs/selection"}},
        "handles": {"description": "Vertices with prescribed positions.", "type": "array", "items": {"$ref": "#/$defs/handle"}},
        "tractions": {"description": "Loads on triangles.", "type": "array", "items": {"$ref": "#/$defs/traction"}}
      }
    },
    "material": {
      "description": "As in a material file.",
      "type": "object", "required": ["name", "density", "poisson_ratio"], "additionalProperties": false,
      "properties": {
        "name": {"description": "Any text.", "type": "string", "maxLength": 1000, "pattern": "^[^\\u0000-\\u001f\\u007f]*$"},
        "density": {"description": "Mass per volume [kg/m^3].", "type": "number", "exclusiveMinimum": 0},
        "poisson_ratio": {"description": "0.5 is incompressible.", "type": "number", "minimum": 0, "maximum": 0.5},
        "shear_modulus": {"description": "[Pa]", "type": "number", "exclusiveMinimum": 0},
        "youngs_modulus": {"description": "[Pa]", "type": "number", "exclusiveMinimum": 0},
        "time_step": {"description": "Time step of archives [s], where none is given.", "type": "number", "exclusiveMinimum": 0}
      },
      "oneOf": [{"required": ["shear_modulus"]}, {"required": ["youngs_modulus"]}]
    },
    "precompute": {
      "description": "Settings of the matrices: the options of bemprecomp, with _ for -.",
      "type": "object", "additionalProperties": false, "properties": "settings"
    },
    "obstacle": {
      "oneOf": [
        {
          "type": "object", "required": ["name", "plane"], "additionalProperties": false,
          "properties": {
            "name": {"$ref": "#/$defs/name"},
            "plane": {"$ref": "#/$defs/plane"},
            "friction": {"$ref": "#/$defs/friction"}
          }
        },
        {
          "type": "object", "required": ["name", "mesh"], "additionalProperties": false,
          "properties": {
            "name": {"$ref": "#/$defs/name"},
            "mesh": {"description": "Any set of triangles: closed parts are solid, both sides of all others hold.", "$ref": "#/$defs/path"},
            "scale": {"$ref": "#/$defs/scale"},
            "position": {"description": "World position of the mesh's origin [m]; default [0, 0, 0].", "$ref": "#/$defs/vec3"},
            "rotation": {"description": "Initial orientation; default none.", "$ref": "#/$defs/rotation"},
            "motion": {"$ref": "#/$defs/motion"},
            "friction": {"$ref": "#/$defs/friction"}
          }
        }
      ]
    },
    "plane": {
      "description": "Half space below a plane.",
      "type": "object", "required": ["point", "normal"], "additionalProperties": false,
      "properties": {
        "point": {"description": "A point of the plane [m].", "$ref": "#/$defs/vec3"},
        "normal": {"description": "Direction out of the obstacle.", "$ref": "#/$defs/vec3"}
      }
    },
    "joint": {
      "oneOf": [
        {
          "type": "object", "required": ["type", "a"], "additionalProperties": false,
          "properties": {
            "type": {"description": "A point of one body stays on a point of another; without \"b\" it stays where it is in the world.", "const": "point"},
            "a": {"$ref": "#/$defs/joint_point"},
            "b": {"$ref": "#/$defs/joint_point"},
            "tolerance": {"$ref": "#/$defs/joint_tolerance"}
          }
        },
        {
          "type": "object", "required": ["type", "a", "b"], "additionalProperties": false,
          "properties": {
            "type": {"description": "The surfaces stay together where they touch at the start.", "const": "weld"},
            "a": {"$ref": "#/$defs/joint_body"},
            "b": {"$ref": "#/$defs/joint_body"},
            "tolerance": {"$ref": "#/$defs/joint_tolerance"}
          }
        }
      ]
    },
    "joint_point": {
      "type": "object", "required": ["body", "point"], "additionalProperties": false,
      "properties": {
        "body": {"description": "Name of a body of the scene.", "type": "string"},
        "point": {"description": "Initial world position [m].", "$ref": "#/$defs/vec3"}
      }
    },
    "joint_body": {
      "type": "object", "required": ["body"], "additionalProperties": false,
      "properties": {"body": {"description": "Name of a body of the scene.", "type": "string"}}
    },
    "joint_tolerance": {"description": "Distance up to which points count as equal [m]; default 1e-6.", "type": "number", "exclusiveMinimum": 0},
    "contact": {
      "description": "Contact and friction; without this object there is none.",
      "type": "object", "additionalProperties": false,
      "properties": {
        "enabled": {"description": "Whether contact is computed; default true.", "type": "boolean"},
        "self": {"description": "Also contact of a body with itself; default false.", "type": "boolean"},
        "tolerance": {"description": "Error allowed in the gaps [m]; default 1e-6.", "type": "number", "exclusiveMinimum": 0},
        "friction_combine": {"description": "Coefficient between two surfaces from theirs; default max.", "enum": "FrictionCombine"},
        "solver": {"description": "How the contact forces are found; default newton.", "enum": "FrictionMethod"}
      }
    },
    "output": {
      "type": "object", "additionalProperties": false,
      "properties": {
        "formats": {"description": "Default [\"hdf5\"].", "type": "array", "minItems": 1, "uniqueItems": true, "items": {"enum": "OutputFormat"}},
        "every": {"description": "Steps from one written frame to the next; default 1.", "type": "integer", "minimum": 1, "maximum": 2147483647},
        "fields": {"description": "Positions are always written; default [\"positions\"].", "type": "array", "minItems": 1, "uniqueItems": true, "items": {"enum": "OutputField"}},
        "surface": {"description": "What is written of bodies with a render mesh: it, the simulated surface, or both, the latter as NAME-simulation; default render.", "enum": "OutputSurface"}
      }
    }
  }
}
)json");
  return schema;
}

}  // namespace bem
