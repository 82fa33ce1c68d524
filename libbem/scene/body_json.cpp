#include "scene/groups.hpp"
#include "scene/repeat.hpp"
#include "scene/scene_parts.hpp"

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
  if (!on && !centre) throw value.error("one of the keys on, center is required");
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

/// What the selections of the body call by name. Its archive has no names of groups.
void resolve_groups(JsonReader& reader, BodySpec& body) {
  const auto groups = reader.optional("groups");
  (groups ? read_groups(*groups) : Groups())
      .resolve(body,
               "; those of a mesh file are not in an archive: write them to the body's \"groups\"");
}

}  // namespace

std::vector<BodySpec> read_bodies(const JsonValue& value) {
  JsonReader reader(value, "a body");
  BodySpec body;
  body.location = value.location();
  body.name = read_name(reader.required("name"));
  body.archive = read_path(reader.required("archive"));
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
