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
    handle.release_time = release->non_negative();
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
    traction.load = reader.required("pressure").number();
  else
    traction.load = reader.required("traction").vec3();
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

void read_placement(JsonReader& reader, BodySpec& body) {
  if (const auto position = reader.optional("position")) body.position = position->vec3();
  if (const auto rotation = reader.optional("rotation")) body.rotation = read_rotation(*rotation);
  if (const auto velocity = reader.optional("velocity")) body.velocity = velocity->vec3();
  if (const auto spin = reader.optional("angular_velocity")) body.angular_velocity = spin->vec3();
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

}  // namespace

BodySpec read_body(const JsonValue& value) {
  JsonReader reader(value, "a body");
  BodySpec body;
  body.location = value.location();
  body.name = read_name(reader.required("name"));
  body.archive = read_path(reader.required("archive"));
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
  reader.finish();
  return body;
}

}  // namespace bem
