#include "scene/schema_text.hpp"

namespace bem {

const char* const kSchemaText = R"json({
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "title": "Scene of bemsim, version 1",
  "description": "Numbers are in SI units, strings have a unit: \"12 mm\". Angles are in degrees where the key says so. Paths are relative to the scene file.",
  "type": "object",
  "anyOf": [{"required": ["version", "duration", "bodies"]}, {"required": ["include"]}],
  "additionalProperties": false,
  "properties": {
    "version": {"description": "Version of this format.", "const": 1},
    "time_step": {
      "description": "Time step [s]; that of every archive of the scene. auto: that of the archives, else from the time that waves take across the bodies; default auto.",
      "anyOf": [{"$ref": "#/$defs/positive"}, {"const": "auto"}]
    },
    "duration": {"description": "Simulated time [s].", "$ref": "#/$defs/non_negative"},
    "gravity": {"description": "Acceleration of gravity [m/s^2]; default [0, 0, 0].", "$ref": "#/$defs/vec3"},
    "bodies": {"type": "array", "minItems": 1, "items": {"$ref": "#/$defs/body"}},
    "obstacles": {"description": "Rigid surroundings; default none.", "type": "array", "items": {"$ref": "#/$defs/obstacle"}},
    "joints": {"description": "Connections of bodies; default none.", "type": "array", "items": {"$ref": "#/$defs/joint"}},
    "contact": {"$ref": "#/$defs/contact"},
    "output": {"$ref": "#/$defs/output"},
    "initial_state": {"$ref": "#/$defs/initial_state"},
    "include": {"$ref": "#/$defs/include"},
    "defaults": {
      "description": "Members of all bodies or obstacles that do not have them.",
      "type": "object", "additionalProperties": false,
      "properties": {
        "body": {"type": "object", "additionalProperties": false, "properties": "of body"},
        "obstacle": {"type": "object", "additionalProperties": false, "properties": "of obstacle"}
      }
    }
  },
  "$defs": {
    "quantity": {"description": "A number in SI units (in degrees where the key says so), or a string with a unit: \"12 mm\".", "type": ["number", "string"], "pattern": "quantity"},
    "positive": {"description": "A quantity > 0.", "type": ["number", "string"], "exclusiveMinimum": 0, "pattern": "non-negative quantity"},
    "non_negative": {"description": "A quantity >= 0.", "type": ["number", "string"], "minimum": 0, "pattern": "non-negative quantity"},
    "vec3": {"description": "[x, y, z]", "type": "array", "items": {"$ref": "#/$defs/quantity"}, "minItems": 3, "maxItems": 3},
    "name": {
      "description": "Name of a body or obstacle, used once in the scene and fit for file names: at most 200 bytes, no '/', no control characters.",
      "type": "string", "maxLength": 200, "pattern": "^[^/\\u0000-\\u001f\\u007f]+$", "not": {"enum": [".", ".."]}
    },
    "path": {"description": "Path of a file, relative to the scene file.", "type": "string", "minLength": 1, "pattern": "^[^\\u0000]+$"},
    "include": {
      "description": "JSON files whose members are put in; those of this object win. Paths are relative to this file.",
      "oneOf": [{"$ref": "#/$defs/path"}, {"type": "array", "items": {"$ref": "#/$defs/path"}}]
    },
    "friction": {"description": "Coefficient of friction; default 0.", "$ref": "#/$defs/non_negative"},
    "scale": {
      "description": "Factor of the mesh's coordinates, one for all axes or one for each; default 1.",
      "oneOf": [
        {"$ref": "#/$defs/positive"},
        {"type": "array", "items": {"$ref": "#/$defs/positive"}, "minItems": 3, "maxItems": 3}
      ]
    },
    "rotation": {
      "description": "Rotation about an axis through the origin.",
      "type": "object", "required": ["axis", "angle_deg"], "additionalProperties": false,
      "properties": {
        "axis": {"description": "Direction of any length but zero.", "$ref": "#/$defs/vec3"},
        "angle_deg": {"description": "Angle [degrees], counter-clockwise seen against the axis.", "$ref": "#/$defs/quantity"}
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
    "sphere": {
      "description": "Ball in mesh coordinates.",
      "type": "object", "required": ["center", "radius"], "additionalProperties": false,
      "properties": {
        "center": {"description": "Centre [m].", "$ref": "#/$defs/vec3"},
        "radius": {"description": "Radius [m].", "$ref": "#/$defs/positive"}
      }
    },
    "normal": {"description": "Only triangles whose outward normal is near this direction (mesh coordinates).", "$ref": "#/$defs/vec3"},
    "normal_tolerance": {"description": "Largest angle between the two [degrees]; default 30.", "$ref": "#/$defs/quantity", "minimum": 0, "maximum": 180},
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
            "normal": {"$ref": "#/$defs/normal"},
            "normal_tolerance_deg": {"$ref": "#/$defs/normal_tolerance"}
          }
        },
        {
          "type": "object", "required": ["sphere"], "additionalProperties": false,
          "dependentRequired": {"normal_tolerance_deg": ["normal"]},
          "properties": {
            "sphere": {"$ref": "#/$defs/sphere"},
            "normal": {"$ref": "#/$defs/normal"},
            "normal_tolerance_deg": {"$ref": "#/$defs/normal_tolerance"}
          }
        },
        {
          "type": "object", "required": ["plane"], "additionalProperties": false,
          "dependentRequired": {"normal_tolerance_deg": ["normal"]},
          "properties": {
            "plane": {"description": "What lies on the side that the normal points to (mesh coordinates).", "$ref": "#/$defs/plane"},
            "normal": {"$ref": "#/$defs/normal"},
            "normal_tolerance_deg": {"$ref": "#/$defs/normal_tolerance"}
          }
        },
        {
          "type": "object", "required": ["group"], "additionalProperties": false,
          "properties": {"group": {"description": "Name of one of the body's groups.", "type": "string"}}
        }
      ]
    },
    "motion": {
      "description": "Keyframes with increasing times; linear in between, constant before the first and after the last.",
      "type": "array",
      "items": {
        "type": "object", "required": ["time"], "additionalProperties": false,
        "properties": {
          "time": {"description": "Time [s].", "$ref": "#/$defs/quantity"},
          "translate": {"description": "Displacement [m], world axes; default [0, 0, 0].", "$ref": "#/$defs/vec3"},
          "rotate": {"description": "Rotation, world axes; default none.", "$ref": "#/$defs/rotation"},
          "about": {"description": "Centre of the rotation [m], world coordinates; default that of the keyframe before, [0, 0, 0] in the first.", "$ref": "#/$defs/vec3"}
        }
      }
    },
    "profile": {
      "description": "Factor over time, [[time [s], factor], ...] with increasing times: linear in between, constant before the first and after the last.",
      "type": "array", "minItems": 1,
      "items": {"type": "array", "items": {"$ref": "#/$defs/quantity"}, "minItems": 2, "maxItems": 2}
    },
    "handle": {
      "type": "object", "required": ["select"], "additionalProperties": false,
      "properties": {
        "select": {"$ref": "#/$defs/selection"},
        "motion": {"description": "Moves the vertices away from their initial world positions; default none: they are held.", "$ref": "#/$defs/motion"},
        "release_time": {"description": "The vertices are free after this time [s]; default never.", "$ref": "#/$defs/non_negative"}
      }
    },
    "traction": {
      "type": "object", "required": ["select"], "additionalProperties": false,
      "properties": {
        "select": {"$ref": "#/$defs/selection"},
        "traction": {"description": "Force per area of the undeformed surface [Pa], world axes.", "$ref": "#/$defs/vec3"},
        "pressure": {"description": "Pressure [Pa], against the outward normal; it turns with the body's frame.", "$ref": "#/$defs/quantity"},
        "profile": {"$ref": "#/$defs/profile"},
        "follow": {"description": "Whether the load turns with the body's frame; default false for a traction, always true for a pressure.", "type": "boolean"}
      },
      "oneOf": [
        {"required": ["traction"]},
        {"required": ["pressure"], "properties": {"follow": {"const": true}}}
      ]
    },
    "body": {
      "type": "object", "additionalProperties": false, "not": {"required": ["position", "place"]},
      "properties": {
        "name": {"$ref": "#/$defs/name"},
        "mesh": {"description": "Closed mesh of the body, from which its matrices are computed where there is no archive.", "$ref": "#/$defs/path"},
        "material": {"description": "Material of the body.", "oneOf": [{"$ref": "#/$defs/path"}, {"$ref": "#/$defs/material"}]},
        "mesh_scale": {"description": "Factor on the coordinates of the mesh; default 1.", "$ref": "#/$defs/positive"},
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
        "tractions": {"description": "Loads on triangles.", "type": "array", "items": {"$ref": "#/$defs/traction"}},
        "groups": {"description": "Selections by name, for {\"group\": NAME}.", "type": "object", "additionalProperties": {"$ref": "#/$defs/selection"}},
        "place": {"$ref": "#/$defs/place"},
        "repeat": {"$ref": "#/$defs/repeat"},
        "include": {"$ref": "#/$defs/include"}
      }
    },
    "material": {
      "description": "As in a material file, but for its time step.",
      "type": "object", "required": ["name", "density", "poisson_ratio"], "additionalProperties": false,
      "properties": {
        "name": {"description": "Any text.", "type": "string", "maxLength": 1000, "pattern": "^[^\\u0000-\\u001f\\u007f]*$"},
        "density": {"description": "Mass per volume [kg/m^3].", "$ref": "#/$defs/positive"},
        "poisson_ratio": {"description": "0.5 is incompressible.", "$ref": "#/$defs/quantity", "minimum": 0, "maximum": 0.5},
        "shear_modulus": {"description": "[Pa]", "$ref": "#/$defs/positive"},
        "youngs_modulus": {"description": "[Pa]", "$ref": "#/$defs/positive"}
      },
      "oneOf": [{"required": ["shear_modulus"]}, {"required": ["youngs_modulus"]}]
    },
    "precompute": {
      "description": "Settings of the matrices: the options of bemprecomp, with _ for -.",
      "type": "object", "additionalProperties": false, "properties": "settings"
    },
    "place": {
      "description": "Decides on the position by what the body looks like, turned by its rotation; instead of \"position\".",
      "type": "object", "additionalProperties": false,
      "anyOf": [{"required": ["on"]}, {"required": ["center"]}],
      "dependentRequired": {"gap": ["on"], "direction": ["on"]},
      "properties": {
        "center": {"description": "World position of the centre of the box around the body [m]; default [0, 0, 0].", "$ref": "#/$defs/vec3"},
        "on": {"description": "Name of the obstacle that the body is moved to.", "type": "string", "minLength": 1},
        "gap": {"description": "What is left between the two [m]; default the tolerance of contact.", "$ref": "#/$defs/non_negative"},
        "direction": {"description": "In which the body comes to an obstacle with a mesh; default that of gravity.", "$ref": "#/$defs/vec3"}
      }
    },
    "repeat": {
      "description": "Makes copies: NAME-0, NAME-1, ... or NAME-0-0-0, NAME-0-0-1, ...",
      "type": "object", "required": ["count", "spacing"], "additionalProperties": false,
      "properties": {
        "count": {
          "description": "Copies in a row, or along the three axes; at most 10000.",
          "oneOf": [{"$ref": "#/$defs/copies"}, {"type": "array", "items": {"$ref": "#/$defs/copies"}, "minItems": 3, "maxItems": 3}]
        },
        "spacing": {"description": "From one copy in a row to the next, or from one to the next along each axis [m].", "$ref": "#/$defs/vec3"},
        "jitter": {
          "description": "Random displacements of the copies; default none.",
          "type": "object", "additionalProperties": false,
          "properties": {
            "position": {"description": "Largest displacement along each axis [m]; default 0.", "$ref": "#/$defs/non_negative"},
            "rotation_deg": {"description": "Largest rotation, about any axis [degrees]; default 0.", "$ref": "#/$defs/quantity", "minimum": 0, "maximum": 180},
            "seed": {"description": "Other displacements for other seeds; default 0.", "type": "integer", "minimum": 0, "maximum": 2147483647}
          }
        }
      }
    },
    "copies": {"type": "integer", "minimum": 1, "maximum": 10000},
    "obstacle": {
      "anyOf": [
        {
          "type": "object", "additionalProperties": false,
          "properties": {
            "name": {"$ref": "#/$defs/name"},
            "plane": {"$ref": "#/$defs/plane"},
            "friction": {"$ref": "#/$defs/friction"},
            "repeat": {"$ref": "#/$defs/repeat"},
            "include": {"$ref": "#/$defs/include"}
          }
        },
        {
          "type": "object", "additionalProperties": false,
          "properties": {
            "name": {"$ref": "#/$defs/name"},
            "mesh": {"description": "Any set of triangles: closed parts are solid, both sides of all others hold.", "$ref": "#/$defs/path"},
            "scale": {"$ref": "#/$defs/scale"},
            "position": {"description": "World position of the mesh's origin [m]; default [0, 0, 0].", "$ref": "#/$defs/vec3"},
            "rotation": {"description": "Initial orientation; default none.", "$ref": "#/$defs/rotation"},
            "motion": {"$ref": "#/$defs/motion"},
            "friction": {"$ref": "#/$defs/friction"},
            "repeat": {"$ref": "#/$defs/repeat"},
            "include": {"$ref": "#/$defs/include"}
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
    "joint_tolerance": {"description": "Distance up to which points count as equal [m]; default 1e-6.", "$ref": "#/$defs/positive"},
    "contact": {
      "description": "Contact and friction; without this object there is none.",
      "type": "object", "additionalProperties": false,
      "properties": {
        "enabled": {"description": "Whether contact is computed; default true.", "type": "boolean"},
        "self": {"description": "Also contact of a body with itself; default false.", "type": "boolean"},
        "tolerance": {"description": "Error allowed in the gaps [m]; default 1e-6.", "$ref": "#/$defs/positive"},
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
    },
    "initial_state": {
      "description": "Bodies start as they are in a trajectory or checkpoint of another run that has bodies of the same names; default: where the scene places them.",
      "type": "object", "additionalProperties": false,
      "oneOf": [{"required": ["trajectory"]}, {"required": ["checkpoint"]}],
      "dependentRequired": {"frame": ["trajectory"]},
      "properties": {
        "trajectory": {"description": "A trajectory.h5: place, rotation and velocities of bodies, which start undeformed.", "$ref": "#/$defs/path"},
        "frame": {"description": "Index of the frame; negative: from the end; default -1, the last.", "type": "integer", "minimum": -2147483647, "maximum": 2147483647},
        "checkpoint": {"description": "A checkpoint.bin: all of the bodies' motion with their deformation and its history.", "$ref": "#/$defs/path"},
        "bodies": {"description": "Names of the bodies that start so; default: all that the file has.", "type": "array", "minItems": 1, "uniqueItems": true, "items": {"type": "string"}}
      }
    }
  }
}
)json";

}  // namespace bem
