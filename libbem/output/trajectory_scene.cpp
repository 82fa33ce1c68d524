#include "output/trajectory_scene.hpp"

#include "base/error.hpp"
#include "output/trajectory_layout.hpp"

#include <charconv>

#include <nlohmann/json.hpp>

namespace bem {
namespace {

Vec3 vector_at(const TrajectoryFile& file, const std::string& path) {
  const std::vector<double> v = file.rows(path, {}, 0, 3);
  return Vec3(v[0], v[1], v[2]);
}

/// Of a quantity: a number, or a text that begins with one; 0 of anything else.
double leading_number(const nlohmann::json& quantity) {
  if (quantity.is_number()) return quantity.get<double>();
  double number = 0;
  if (quantity.is_string()) {
    const auto& text = quantity.get_ref<const std::string&>();
    std::from_chars(text.data(), text.data() + text.size(), number);
  }
  return number;
}

RecordedObstacle read_obstacle(const TrajectoryFile& file, const std::string& name) {
  const std::string group = "/obstacles/" + name;
  RecordedObstacle o;
  o.name = name;
  o.is_plane = file.has(group + "/normal");
  if (o.is_plane) {
    o.point = vector_at(file, group + "/point");
    o.normal = vector_at(file, group + "/normal").normalized();
    return o;
  }
  const std::size_t count = file.row_count(group + "/vertices");
  o.vertices = file.rows(group + "/vertices", {3}, 0, count);
  o.triangles = file.triangles(group + "/faces", count);
  o.translations = file.all_frames(group + "/translation", {3});
  o.rotations = file.all_frames(group + "/rotation", {3, 3});
  return o;
}

}  // namespace

std::vector<RecordedObstacle> read_obstacles(const TrajectoryFile& file) {
  std::vector<RecordedObstacle> obstacles;
  for (const std::string& name : file.names("/obstacles"))
    obstacles.push_back(read_obstacle(file, name));
  return obstacles;
}

std::vector<std::size_t> contact_ends(const TrajectoryFile& file) {
  std::vector<std::size_t> ends;
  if (!file.has(kContactCountsPath)) return ends;
  std::size_t rows = 0;
  const std::size_t frames = file.times().size();
  for (double count : file.rows(kContactCountsPath, {}, 0, frames, Hdf5Type::int32)) {
    if (count < 0)
      throw Error(file.error(), file.path() + ": " + kContactCountsPath + " has a negative number");
    rows += static_cast<std::size_t>(count);
    ends.push_back(rows);
  }
  return ends;
}

RecordedContacts read_contacts(const TrajectoryFile& file) {
  RecordedContacts contacts;
  contacts.ends = contact_ends(file);
  if (contacts.ends.empty()) return contacts;
  contacts.points = file.rows("/contacts/points", {3}, 0, contacts.ends.back());
  contacts.forces = file.rows("/contacts/forces", {3}, 0, contacts.ends.back());
  return contacts;
}

Vec3 up_of_scene(const std::string& text) {
  const auto scene = nlohmann::json::parse(text, nullptr, false, true);
  Vec3 gravity = Vec3::Zero();
  if (scene.is_object() && scene.contains("gravity") && scene["gravity"].is_array() &&
      scene["gravity"].size() == 3)
    for (int i = 0; i < 3; ++i) gravity[i] = leading_number(scene["gravity"][i]);
  return gravity.norm() > 0 ? Vec3(-gravity.normalized()) : Vec3(Vec3::UnitY());
}

}  // namespace bem
