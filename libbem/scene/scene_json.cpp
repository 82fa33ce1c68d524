#include "scene/scene_json.hpp"

#include "scene/json_reader.hpp"
#include "scene/scene_parts.hpp"

#include <limits>
#include <map>

namespace bem {
namespace {

constexpr double kMaxSteps = std::numeric_limits<int>::max();

/// Bodies and obstacles share the names by which messages and results speak of them.
class NamesInUse {
 public:
  void add(const JsonValue& name) {
    const auto [first, added] = first_.emplace(name.text(), name.location().pointer);
    if (!added)
      throw name.error("the name " + in_quotes(name.text()) + " is already used at " +
                       first->second);
  }

  /// Those that trajectories need in addition must be free.
  void check_simulation_names(const std::vector<BodySpec>& bodies) const {
    for (const BodySpec& body : bodies) {
      const auto taken = first_.find(simulation_name(body.name));
      if (body.render_mesh && taken != first_.end())
        throw error_at(body.location, "the simulated surface of the body " + in_quotes(body.name) +
                                          " would be written as " + in_quotes(taken->first) +
                                          ", which is already used at " + taken->second);
    }
  }

 private:
  std::map<std::string, std::string> first_;
};

void read_timing(JsonReader& reader, Scene& scene) {
  scene.time_step_location = scene.location;
  if (const auto time_step = reader.optional("time_step")) {
    scene.time_step_location = time_step->location();
    if (time_step->kind() != JsonKind::string || time_step->text() != "auto")
      scene.time_step = time_step->positive();
  }
  const JsonValue duration = reader.required("duration");
  scene.duration = duration.non_negative();
  if (scene.time_step > 0 && !(scene.duration / scene.time_step <= kMaxSteps))
    throw duration.error("expected at most 2147483647 time steps, found a duration of more");
}

Scene scene_from(const JsonDocument& document) {
  JsonReader reader(JsonValue(document, 0), "a scene");
  Scene scene;
  scene.location = reader.location();
  const JsonValue version = reader.required("version");
  if (version.number() != 1) throw version.unexpected("the version number 1");
  read_timing(reader, scene);
  if (const auto gravity = reader.optional("gravity")) scene.gravity = gravity->vec3();

  NamesInUse names;
  for (const JsonValue& body : reader.required("bodies").items(1, "array of bodies")) {
    scene.bodies.push_back(read_body(body));
    names.add(JsonReader(body, "a body").required("name"));
  }
  if (const auto obstacles = reader.optional("obstacles"))
    for (const JsonValue& obstacle : obstacles->items(0, "array of obstacles")) {
      scene.obstacles.push_back(read_obstacle(obstacle));
      names.add(JsonReader(obstacle, "an obstacle").required("name"));
    }
  if (const auto joints = reader.optional("joints")) {
    BodyNames bodies;
    for (const BodySpec& body : scene.bodies) bodies.emplace(body.name, bodies.size());
    for (const JsonValue& joint : joints->items(0, "array of joints"))
      scene.joints.push_back(read_joint(joint, bodies));
  }
  if (const auto contact = reader.optional("contact")) scene.contact = read_contact(*contact);
  if (const auto output = reader.optional("output")) scene.output = read_output(*output);
  if (scene.output.surface == OutputSurface::both) names.check_simulation_names(scene.bodies);
  reader.finish();
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
