#include "base/nearest_name.hpp"
#include "scene/repeat.hpp"
#include "scene/scene_parts.hpp"

#include <algorithm>
#include <limits>

namespace bem {
namespace {

PlaneObstacle read_plane(const JsonValue& value) {
  JsonReader reader(value, "a plane");
  PlaneObstacle plane;
  plane.point = reader.required("point").vec3(dimension::length);
  plane.normal = reader.required("normal").direction();
  reader.finish();
  return plane;
}

/// One factor for all axes, or three.
Vec3 read_scale(const JsonValue& value) {
  if (value.kind() == JsonKind::number || value.kind() == JsonKind::string)
    return Vec3::Constant(value.positive());
  if (value.kind() != JsonKind::array) throw value.unexpected("a number > 0, or three of them");
  const Vec3 scale = value.vec3();
  if (!(scale.array() > 0).all()) throw value.error("expected three numbers > 0");
  return scale;
}

JointEnd read_joint_end(const JsonValue& value, JointType type, const ThingNames& bodies) {
  JsonReader reader(value, "a side of a joint");
  JointEnd end;
  end.location = value.location();
  const JsonValue body = reader.required("body");
  end.body = thing_named(body.text(), body.location(), bodies, "a body");
  if (type == JointType::point)
    end.point = reader.required("point").vec3(dimension::length);
  else
    reader.refuse("point", "is allowed only in joints of type \"point\"");
  reader.finish();
  return end;
}

/// Known by their names.
std::vector<const OutputFormat*> read_formats(const JsonValue& value) {
  std::vector<const OutputFormat*> formats;
  for (std::size_t index : value.choices(output_format_names(), "array of formats"))
    formats.push_back(output_formats()[index]);
  return formats;
}

}  // namespace

std::size_t thing_named(const std::string& name, const Location& place, const ThingNames& things,
                        const std::string& what) {
  const auto match = things.find(name);
  if (match != things.end()) return match->second;
  std::vector<std::string> names;
  names.reserve(things.size());
  for (const auto& [known, index] : things) names.push_back(known);
  const std::string nearest = nearest_name(name, names);
  throw error_at(place, "expected the name of " + what + " of this scene, found " +
                            in_quotes(name) +
                            (nearest.empty() ? "" : "; did you mean " + in_quotes(nearest) + "?"));
}

std::vector<ObstacleSpec> read_obstacles(const JsonValue& value) {
  JsonReader reader(value, "an obstacle");
  ObstacleSpec obstacle;
  obstacle.location = value.location();
  obstacle.name = read_name(reader.required("name"));
  if (reader.required_one_of({"plane", "mesh"}) == "plane") {
    obstacle.shape = read_plane(reader.required("plane"));
    for (const char* key : {"scale", "position", "rotation", "motion"})
      reader.refuse(key, "is allowed only beside \"mesh\"");
  } else {
    MeshObstacle mesh;
    mesh.mesh = read_path(reader.required("mesh"));
    if (const auto scale = reader.optional("scale")) mesh.scale = read_scale(*scale);
    if (const auto position = reader.optional("position"))
      mesh.position = position->vec3(dimension::length);
    if (const auto rotation = reader.optional("rotation")) mesh.rotation = read_rotation(*rotation);
    if (const auto motion = reader.optional("motion")) mesh.motion = read_motion(*motion);
    obstacle.shape = mesh;
  }
  if (const auto friction = reader.optional("friction"))
    obstacle.friction = friction->non_negative();
  const auto repeat = reader.optional("repeat");
  reader.optional("include");  // expanded_scene() has put it in
  reader.finish();
  return repeated(obstacle, repeat);
}

JointSpec read_joint(const JsonValue& value, const ThingNames& bodies) {
  JsonReader reader(value, "a joint");
  JointSpec joint;
  joint.location = value.location();
  joint.type = reader.required("type").choice<JointType>();
  joint.a = read_joint_end(reader.required("a"), joint.type, bodies);
  const auto b = joint.type == JointType::point ? reader.optional("b") : reader.required("b");
  if (b) {
    joint.b = read_joint_end(*b, joint.type, bodies);
    if (joint.a.body == joint.b->body)
      throw JsonReader(*b, "a side of a joint")
          .required("body")
          .error("expected another body than at the side \"a\" of the joint");
  }
  if (const auto tolerance = reader.optional("tolerance"))
    joint.tolerance = tolerance->positive(dimension::length);
  reader.finish();
  return joint;
}

ContactSpec read_contact(const JsonValue& value) {
  JsonReader reader(value, "the contact settings");
  ContactSpec contact;
  contact.location = value.location();
  contact.enabled = true;
  if (const auto enabled = reader.optional("enabled")) contact.enabled = enabled->boolean();
  if (const auto self = reader.optional("self")) contact.self = self->boolean();
  if (const auto tolerance = reader.optional("tolerance"))
    contact.tolerance = tolerance->positive(dimension::length);
  if (const auto combine = reader.optional("friction_combine"))
    contact.friction_combine = combine->choice<FrictionCombine>();
  if (const auto solver = reader.optional("solver"))
    contact.solver = solver->choice<FrictionMethod>();
  reader.finish();
  return contact;
}

InitialStateSpec read_initial_state(const JsonValue& value, const ThingNames& bodies) {
  JsonReader reader(value, "the initial state");
  InitialStateSpec state;
  state.location = value.location();
  state.is_checkpoint = reader.required_one_of({"trajectory", "checkpoint"}) == "checkpoint";
  state.file = read_path(reader.required(state.is_checkpoint ? "checkpoint" : "trajectory"));
  if (state.is_checkpoint) reader.refuse("frame", "is allowed only beside \"trajectory\"");
  constexpr int kMost = std::numeric_limits<int>::max();
  if (const auto frame = reader.optional("frame")) state.frame = frame->integer_in(-kMost, kMost);
  if (const auto names = reader.optional("bodies"))
    for (const JsonValue& name : names->items(1, "array of bodies")) {
      const std::size_t body = thing_named(name.text(), name.location(), bodies, "a body");
      if (std::find(state.bodies.begin(), state.bodies.end(), body) != state.bodies.end())
        throw name.error("the body " + in_quotes(name.text()) + " is named twice");
      state.bodies.push_back(body);
    }
  reader.finish();
  return state;
}

OutputSpec read_output(const JsonValue& value) {
  JsonReader reader(value, "the output settings");
  OutputSpec output;
  output.location = value.location();
  if (const auto formats = reader.optional("formats")) output.formats = read_formats(*formats);
  if (const auto every = reader.optional("every"))
    output.every = every->integer_in(1, std::numeric_limits<int>::max());
  if (const auto fields = reader.optional("fields"))
    output.fields = fields->choices<OutputField>("array of fields");
  if (const auto surface = reader.optional("surface"))
    output.surface = surface->choice<OutputSurface>();
  reader.finish();
  return output;
}

}  // namespace bem
