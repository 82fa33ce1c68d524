#include "scene/scene_json.hpp"

#include "scene/expansion.hpp"
#include "scene/json_reader.hpp"
#include "scene/scene_parts.hpp"

#include <limits>
#include <map>

namespace bem {
namespace {

constexpr double kMaxSteps = std::numeric_limits<int>::max();

constexpr std::size_t kMostThings = 100000;

/// Bodies and obstacles share the names by which messages and results speak of them.
class NamesInUse {
 public:
  /// `place` is that of the name that `name` was made of.
  void add(const std::string& name, const JsonValue& place) {
    const auto [first, added] = first_.emplace(name, place.location());
    if (added) return;
    Location at = first->second;
    if (at.file == place.location().file) at = {at.pointer, 0, 0, ""};
    throw place.error("the name " + in_quotes(name) + " is already used at " + where(at));
  }

  /// Those that trajectories need in addition must be free.
  void check_simulation_names(const std::vector<BodySpec>& bodies) const {
    for (const BodySpec& body : bodies) {
      const auto taken = first_.find(simulation_name(body.name));
      if (body.render_mesh && taken != first_.end())
        throw error_at(body.location, "the simulated surface of the body " + in_quotes(body.name) +
                                          " would be written as " + in_quotes(taken->first) +
                                          ", which is already used at " + where(taken->second));
    }
  }

 private:
  std::map<std::string, Location> first_;
};

/// Appends what `read` makes of the elements of a list of bodies or obstacles.
template <class Thing, class Read>
void read_things(const std::vector<JsonValue>& items, const Read& read, NamesInUse& names,
                 std::vector<Thing>& things) {
  for (const JsonValue& item : items)
    for (Thing& thing : read(item)) {
      names.add(thing.name, JsonReader(item, "an element").required("name"));
      if (things.size() == kMostThings)
        throw item.error("the scene has more than " + std::to_string(kMostThings) +
                         " bodies or obstacles");
      things.push_back(std::move(thing));
    }
}

template <class Thing>
ThingNames names_of(const std::vector<Thing>& things) {
  ThingNames names;
  for (const Thing& thing : things) names.emplace(thing.name, names.size());
  return names;
}

/// What expanded_scene() has written into bodies and obstacles is checked there.
void check_defaults(const JsonValue& value) {
  JsonReader reader(value, "the defaults");
  for (const char* key : {"body", "obstacle"})
    if (const auto defaults = reader.optional(key))
      JsonReader(*defaults, std::string("the defaults of ") + key);
  reader.finish();
}

void read_timing(JsonReader& reader, Scene& scene) {
  scene.time_step_location = scene.location;
  if (const auto time_step = reader.optional("time_step")) {
    scene.time_step_location = time_step->location();
    if (time_step->kind() != JsonKind::string || time_step->text() != "auto")
      scene.time_step = time_step->positive(dimension::time);
  }
  const JsonValue duration = reader.required("duration");
  scene.duration = duration.non_negative(dimension::time);
  if (scene.time_step > 0 && !(scene.duration / scene.time_step <= kMaxSteps))
    throw duration.error("expected at most 2147483647 time steps, found a duration of more");
}

/// Completes where a body is placed with what the rest of the scene says.
void complete_place(PlaceSpec& place, const Scene& scene, const ThingNames& obstacles) {
  place.obstacle = thing_named(place.on, place.on_location, obstacles, "an obstacle");
  const ObstacleSpec& obstacle = scene.obstacles[place.obstacle];
  if (!place.gap) place.gap = scene.contact.tolerance;
  if (const auto* plane = std::get_if<PlaneObstacle>(&obstacle.shape)) {
    if (place.direction)
      throw error_at(place.location,
                     "\"direction\" is for obstacles with a mesh; a body comes to lie on a plane "
                     "along its normal");
    place.direction = -plane->normal;
  }
  if (place.direction) return;
  if (scene.gravity.isZero(0))
    throw error_at(place.location,
                   "a scene without gravity needs a \"direction\" here, in which "
                   "the body falls onto " +
                       in_quotes(obstacle.name));
  place.direction = scene.gravity.normalized();
}

void complete_places(Scene& scene) {
  const ThingNames obstacles = names_of(scene.obstacles);
  for (BodySpec& body : scene.bodies)
    if (body.place && !body.place->on.empty()) complete_place(*body.place, scene, obstacles);
}

/// What of the scene may act on single vertices of a body, as the scene calls it, or empty.
std::string what_acts_on(const Scene& scene, std::size_t b) {
  const BodySpec& body = scene.bodies[b];
  if (!body.fixed.empty()) return "\"fixed\"";
  if (!body.handles.empty()) return "\"handles\"";
  for (const JointSpec& joint : scene.joints)
    if (joint.a.body == b || (joint.b && joint.b->body == b)) return "\"joints\"";
  return scene.contact.enabled ? "\"contact\"" : "";
}

void check_loads(const Scene& scene) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const std::optional<BodySource>& source = scene.bodies[b].source;
    if (!source || source->settings.loads != "none") continue;
    const std::string acting = what_acts_on(scene, b);
    if (source->settings.model != ModelKind::rigid && !acting.empty())
      throw error_at(source->loads_location,
                     "a body without loads cannot be held or touched, but " + acting +
                         " of the scene may act on it; leave \"loads\" away");
  }
}

Scene scene_of(const JsonDocument& document) {
  JsonReader reader(JsonValue(document, document.root()), "a scene");
  Scene scene;
  scene.files = document.files();
  scene.location = reader.location();
  const JsonValue version = reader.required("version");
  if (version.kind() != JsonKind::number || version.number() != 1)
    throw version.unexpected("the version number 1");
  read_timing(reader, scene);
  if (const auto gravity = reader.optional("gravity"))
    scene.gravity = gravity->vec3(dimension::acceleration);

  NamesInUse names;
  const auto bodies = reader.required("bodies").items(1, "array of bodies");
  read_things(bodies, read_bodies, names, scene.bodies);
  if (const auto obstacles = reader.optional("obstacles"))
    read_things(obstacles->items(0, "array of obstacles"), read_obstacles, names, scene.obstacles);
  const ThingNames known = names_of(scene.bodies);
  if (const auto joints = reader.optional("joints"))
    for (const JsonValue& joint : joints->items(0, "array of joints"))
      scene.joints.push_back(read_joint(joint, known));
  if (const auto contact = reader.optional("contact")) scene.contact = read_contact(*contact);
  if (const auto output = reader.optional("output")) scene.output = read_output(*output);
  if (const auto state = reader.optional("initial_state"))
    scene.initial_state = read_initial_state(*state, known);
  if (scene.output.surface == OutputSurface::both) names.check_simulation_names(scene.bodies);
  reader.optional("include");  // expanded_scene() has put it in
  if (const auto defaults = reader.optional("defaults")) check_defaults(*defaults);
  reader.finish();
  complete_places(scene);
  check_loads(scene);
  return scene;
}

Scene scene_from(JsonDocument document) {
  std::string text = document.text();
  Scene scene = scene_of(expanded_scene(std::move(document)));
  scene.text = std::move(text);
  return scene;
}

}  // namespace

Scene read_scene(const std::string& path) {
  return scene_from(JsonDocument::read(path));
}

Scene parse_scene(const std::string& file, const std::string& text) {
  return scene_from(JsonDocument::parse(file, text));
}

}  // namespace bem
