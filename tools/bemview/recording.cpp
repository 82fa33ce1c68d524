#include "recording.hpp"

#include "output/trajectory_scene.hpp"
#include "scene/location.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace bem {
namespace {

/// What a body has beside fields.
const std::set<std::string> kNoFields{"positions", "faces", "frame", "series", "stress"};

[[noreturn]] void refuse_name(const std::string& kind, const std::string& name,
                              const std::vector<std::string>& known, const std::string& path) {
  std::string list;
  for (const std::string& k : known) list += (list.empty() ? "" : ", ") + in_quotes(k);
  throw Error(ErrorCode::usage, path + ": has no " + kind + " " + in_quotes(name) + ", but " +
                                    (list.empty() ? "none at all" : list));
}

/// The simulated surface of a body that is in the file as a render mesh, too.
bool is_beside_render_mesh(const TrajectoryFile& file, const std::string& body) {
  return file.text("/bodies/" + body, kSurfaceAttribute) == kSimulatedSurface;
}

/// In the order of the scene; simulated surfaces beside render meshes if they are asked for.
std::vector<std::string> chosen_bodies(const TrajectoryFile& file,
                                       const std::vector<std::string>& asked) {
  std::vector<std::string> all = file.names("/bodies"), chosen;
  for (const std::string& name : asked)
    if (std::find(all.begin(), all.end(), name) == all.end())
      refuse_name("body", name, all, file.path());
  for (const std::string& name : all)
    if (asked.empty() ? !is_beside_render_mesh(file, name)
                      : std::find(asked.begin(), asked.end(), name) != asked.end())
      chosen.push_back(name);
  if (chosen.empty()) throw Error(ErrorCode::archive, file.path() + ": has no body to show");
  return chosen;
}

std::string label_of(std::string name) {
  if (name == "tractions") return "traction";
  if (name == "von_mises") return "von Mises stress";
  if (name == "velocities") return "speed";
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string dataset(const ViewField& field) {
  return field.name == kSpeed ? "velocities" : field.name;
}

}  // namespace

std::vector<std::size_t> chosen_frames(const std::vector<double>& times, std::size_t every,
                                       double rate) {
  std::vector<std::size_t> frames;
  double last_place = -1, last_distance = 0;
  for (std::size_t k = 0; k < times.size(); k += every) {
    const double exact = (times[k] - times[0]) * rate, place = std::round(exact);
    const double distance = std::abs(exact - place);
    const bool is_new = rate == 0 || place != last_place;
    if (is_new)
      frames.push_back(k);
    else if (distance < last_distance)
      frames.back() = k;
    if (is_new || distance < last_distance) last_distance = distance;
    last_place = place;
  }
  return frames;
}

std::vector<double> lengths(const std::vector<double>& numbers, std::size_t components) {
  std::vector<double> out(numbers.size() / components);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = Eigen::Map<const Eigen::VectorXd>(numbers.data() + i * components,
                                               static_cast<Eigen::Index>(components))
                 .norm();
  return out;
}

Recording::Recording(const ViewOptions& options)
    : file_(options.trajectory, ErrorCode::archive),
      bodies_(chosen_bodies(file_, options.bodies)),
      frames_(chosen_frames(file_.times(), options.every, options.rate)),
      up_(up_of_scene(file_.text("/", "scene"))) {
  if (frames_.empty()) throw Error(ErrorCode::archive, file_.path() + ": has no frame to show");
  choose_fields(options.fields);
}

/// Those that any body has: datasets with a number or a vector per vertex.
std::vector<ViewField> Recording::stored_fields() const {
  std::vector<ViewField> fields;
  std::set<std::string> known = kNoFields;
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    for (const std::string& name : file_.children(group(b))) {
      const std::string path = group(b) + "/" + name;
      const Hdf5Dims extents = known.count(name) ? Hdf5Dims() : file_.row_extents(path);
      const bool fits = !extents.empty() && extents[0] == file_.vertices(bodies_[b]) &&
                        (extents.size() == 1 || (extents.size() == 2 && extents[1] == 3));
      if (!fits) continue;
      known.insert(name);
      fields.push_back({name == "velocities" ? kSpeed : name, label_of(name),
                        file_.text(path, "units"), extents.size() == 1 ? 1u : 3u, true});
    }
  return fields;
}

void Recording::choose_fields(const std::vector<std::string>& asked) {
  const auto called = [](const std::string& name) {
    return [name](const ViewField& f) { return f.name == name; };
  };
  std::vector<ViewField> all = stored_fields();
  if (std::none_of(all.begin(), all.end(), called(kSpeed)) && frames_.size() > 1)
    all.push_back({kSpeed, kSpeed, "m/s", 3, false});
  std::stable_partition(all.begin(), all.end(), called(kSpeed));
  all.insert(all.begin(), {kDisplacement, kDisplacement, "m", 3, false});
  std::vector<std::string> names;
  for (const ViewField& field : all) names.push_back(field.name);
  for (const std::string& name : asked)
    if (name != "none" && std::none_of(all.begin(), all.end(), called(name)))
      refuse_name("field", name, names, file_.path());
  for (const ViewField& field : all)
    if (asked.empty() || std::find(asked.begin(), asked.end(), field.name) != asked.end())
      fields_.push_back(field);
}

std::vector<double> Recording::times() const {
  std::vector<double> out;
  for (std::size_t k : frames_) out.push_back(file_.times()[k]);
  return out;
}

std::vector<std::string> Recording::datasets() const {
  std::vector<std::string> names;
  for (const ViewField& field : fields_)
    if (field.stored) names.push_back(dataset(field));
  return names;
}

Pose Recording::pose(std::size_t body, std::size_t frame) const {
  if (!file_.has(group(body) + "/frame/rotation")) return {};
  double translation[3], rotation[9];
  file_.read(bodies_[body], "/frame/translation", {3}, frames_[frame], translation);
  file_.read(bodies_[body], "/frame/rotation", {3, 3}, frames_[frame], rotation);
  return Pose(translation, rotation);
}

std::vector<double> Recording::positions(std::size_t body, std::size_t frame) const {
  const std::size_t count = file_.vertices(bodies_[body]);
  std::vector<double> out(3 * count);
  file_.read(bodies_[body], "/positions", {count, 3}, frames_[frame], out.data());
  return out;
}

bool Recording::has_field(std::size_t body, const ViewField& field) const {
  return !field.stored || file_.has(group(body) + "/" + dataset(field));
}

std::vector<double> Recording::values(std::size_t body, const ViewField& field,
                                      std::size_t frame) const {
  const std::size_t count = file_.vertices(bodies_[body]);
  const Hdf5Dims extents =
      field.components == 1 ? Hdf5Dims{count} : Hdf5Dims{count, field.components};
  std::vector<double> out(count * field.components);
  file_.read(bodies_[body], "/" + dataset(field), extents, frames_[frame], out.data());
  return lengths(out, field.components);
}

}  // namespace bem
