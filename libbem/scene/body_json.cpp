#include "mesh/describe.hpp"
#include "mesh/mesh_io.hpp"
#include "scene/groups.hpp"
#include "scene/material_json.hpp"
#include "scene/named_materials.hpp"
#include "scene/repeat.hpp"
#include "scene/scene_parts.hpp"
#include "scene/selection.hpp"

namespace bem {
namespace {

HandleSpec read_handle(const JsonValue& value) {
  JsonReader reader(value, "a handle");
  HandleSpec handle;
  handle.location = value.location();
  handle.select = read_selection(reader.required("select"));
  if (const auto motion = reader.optional("motion")) handle.motion = read_motion(*motion);
  if (const auto release = reader.optional("release_time"))
    handle.release_time = release->non_negative(dimension::time);
  reader.finish();
  return handle;
}

TractionSpec read_traction(const JsonValue& value) {
  JsonReader reader(value, "a traction");
  TractionSpec traction;
  traction.location = value.location();
  traction.select = read_selection(reader.required("select"));
  const bool pressure = reader.required_one_of({"traction", "pressure"}) == "pressure";
  if (pressure)
    traction.load = reader.required("pressure").number(dimension::pressure);
  else
    traction.load = reader.required("traction").vec3(dimension::pressure);
  if (const auto profile = reader.optional("profile")) traction.profile = read_profile(*profile);
  traction.follow = pressure;
  if (const auto follow = reader.optional("follow")) {
    traction.follow = follow->boolean();
    if (pressure && !traction.follow)
      throw follow->unexpected("true, because a pressure turns with the body");
  }
  reader.finish();
  return traction;
}

PlaceSpec read_place(const JsonValue& value) {
  JsonReader reader(value, "a place");
  reader.require_any_of({"on", "center"});
  PlaceSpec place;
  place.location = value.location();
  const auto centre = reader.optional("center");
  if (centre) place.centre = centre->vec3(dimension::length);
  const auto on = reader.optional("on");
  if (on) {
    place.on = on->text();
    place.on_location = on->location();
    if (place.on.empty()) throw on->unexpected("the name of an obstacle");
  }
  if (const auto gap = reader.optional("gap")) place.gap = gap->non_negative(dimension::length);
  if (const auto direction = reader.optional("direction")) place.direction = direction->direction();
  for (const char* key : {"gap", "direction"})
    if (!on) reader.refuse(key, "is allowed only beside \"on\"");
  reader.finish();
  return place;
}

void read_placement(JsonReader& reader, BodySpec& body) {
  if (const auto place = reader.optional("place")) {
    if (reader.optional("position")) reader.refuse("place", "is not allowed beside \"position\"");
    body.place = read_place(*place);
  }
  if (const auto position = reader.optional("position"))
    body.position = position->vec3(dimension::length);
  if (const auto rotation = reader.optional("rotation")) body.rotation = read_rotation(*rotation);
  if (const auto velocity = reader.optional("velocity"))
    body.velocity = velocity->vec3(dimension::velocity);
  if (const auto spin = reader.optional("angular_velocity"))
    body.angular_velocity = spin->vec3(dimension::angular_velocity);
}

void read_constraints_and_loads(JsonReader& reader, BodySpec& body) {
  if (const auto fixed = reader.optional("fixed"))
    for (const JsonValue& item : fixed->items(0, "array of selections"))
      body.fixed.push_back(read_selection(item));
  if (const auto handles = reader.optional("handles"))
    for (const JsonValue& item : handles->items(0, "array of handles"))
      body.handles.push_back(read_handle(item));
  if (const auto tractions = reader.optional("tractions"))
    for (const JsonValue& item : tractions->items(0, "array of tractions"))
      body.tractions.push_back(read_traction(item));
}

/// The value of a setting as the command line would have it.
std::string setting_text(const JsonValue& value, Setting::Kind kind) {
  using Kind = Setting::Kind;
  if (kind == Kind::flag) return value.boolean() ? "true" : "false";
  if (kind == Kind::text && value.kind() == JsonKind::string) return value.text();
  if (kind == Kind::text && value.kind() != JsonKind::number)
    throw value.unexpected("a string or a number");
  return to_text(value.number());
}

PrecomputeSettings read_settings(const JsonValue& value) {
  JsonReader reader(value, "an object of settings");
  PrecomputeSettings settings;
  for (const Setting& setting : precompute_settings()) {
    if (!setting.in_scenes) {
      reader.refuse(setting.key(), "is no setting of a body: the scene has the \"time_step\"");
      continue;
    }
    const auto given = reader.optional(setting.key());
    if (!given) continue;
    const std::string text = setting_text(*given, setting.kind);
    at_place_of_input(given->location(), [&] {
      setting.set(settings, setting_name(SettingStyle::key, setting.name), text);
    });
  }
  reader.finish();
  at_place_of_input(value.location(), [&] { check_settings(settings, SettingStyle::key); });
  if (settings.has_load_file()) settings.loads = read_path(reader.required("loads")).resolved;
  return settings;
}

BodySource read_source(const JsonValue& mesh, JsonReader& reader) {
  BodySource source;
  source.mesh = read_path(mesh);
  if (const auto scale = reader.optional("mesh_scale")) source.mesh_scale = scale->positive();
  const JsonValue material = reader.required("material");
  source.material = read_material_value(material);
  if (material.kind() == JsonKind::string && !is_named_material(material.text()))
    source.material_path = read_path(material);
  source.material_path.location = material.location();
  if (const auto settings = reader.optional("precompute")) {
    source.settings = read_settings(*settings);
    if (const auto loads = JsonReader(*settings, "settings").optional("loads"))
      source.loads_location = loads->location();
  }
  return source;
}

/// The body's archive, or the mesh and material that it is computed from, or both.
void read_model(JsonReader& reader, BodySpec& body) {
  reader.require_any_of({"archive", "mesh"});
  const auto archive = reader.optional("archive"), mesh = reader.optional("mesh");
  if (mesh) body.source = read_source(*mesh, reader);
  if (archive) {
    body.archive = read_path(*archive);
    reader.refuse("precompute", "has no effect on a body whose \"archive\" is given");
  } else {
    body.archive.written = body.source->mesh.written;
    body.archive.location = body.source->mesh.location;
  }
  for (const char* key : {"material", "mesh_scale", "precompute"})
    if (reader.optional(key) && !mesh) reader.refuse(key, "belongs to a body with a \"mesh\"");
}

Groups read_groups(const JsonValue& value) {
  Groups groups;
  for (const auto& [name, member] : value.members("the groups of a body")) {
    const Selection selection = read_selection(member);
    if (selection.kind == Selection::Kind::group)
      throw member.error("a group cannot consist of another one");
    groups.add(name, selection);
  }
  return groups;
}

bool names_groups(const BodySpec& body) {
  bool any = false;
  for_each_selection(body,
                     [&](const Selection& s) { any = any || s.kind == Selection::Kind::group; });
  return any;
}

/// What the selections of the body call by name: groups of the scene, and those of its mesh file.
void resolve_groups(JsonReader& reader, BodySpec& body) {
  const auto given = reader.optional("groups");
  Groups groups = given ? read_groups(*given) : Groups();
  if (!names_groups(body)) return;
  if (body.source)
    groups.set_of_mesh(at_place(body.source->mesh.location,
                                [&] { return read_mesh_groups(body.source->mesh.resolved); }));
  groups.resolve(body, body.source ? ""
                                   : "; those of a mesh file are not in an archive: write them to "
                                     "the body's \"groups\"");
}

}  // namespace

std::vector<BodySpec> read_bodies(const JsonValue& value) {
  JsonReader reader(value, "a body");
  BodySpec body;
  body.location = value.location();
  body.name = read_name(reader.required("name"));
  read_model(reader, body);
  if (const auto mesh = reader.optional("render_mesh")) body.render_mesh = read_path(*mesh);
  read_placement(reader, body);
  if (const auto frame = reader.optional("frame")) body.frame = frame->choice<FrameMotion>();
  if (const auto correction = reader.optional("correction")) {
    body.correction = correction->choice<Correction>();
    if (body.correction == Correction::least_squares && body.is_stationary())
      throw correction->unexpected("\"projection\", because a stationary frame has no other");
  }
  if (const auto gravity = reader.optional("gravity")) body.gravity = gravity->boolean();
  if (const auto stretch = reader.optional("centrifugal")) body.centrifugal = stretch->boolean();
  if (const auto friction = reader.optional("friction")) body.friction = friction->non_negative();
  read_constraints_and_loads(reader, body);
  resolve_groups(reader, body);
  const auto repeat = reader.optional("repeat");
  reader.optional("include");  // expanded_scene() has put it in
  reader.finish();
  return repeated(body, repeat);
}

}  // namespace bem
