#include "scene/scene_parts.hpp"

#include <algorithm>
#include <filesystem>

namespace bem {
namespace {

/// Throws unless `value`, the time of an element of a list, is later than the one before it.
double later_than(const std::optional<double>& before, const JsonValue& value) {
  const double time = value.number(dimension::time);
  if (before && !(time > *before))
    throw value.unexpected("a later time than in the element before");
  return time;
}

/// Paths as Windows writes them, which lead to a file if they are written with slashes.
void refuse_backslashes(const JsonValue& value, const std::filesystem::path& folder) {
  std::string slashes = value.text();
  if (slashes.find('\\') == std::string::npos) return;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  std::error_code unknown;
  if (!std::filesystem::exists(folder / value.text(), unknown) &&
      std::filesystem::exists(folder / slashes, unknown))
    throw value.error("there is no file " + in_quotes(value.text()) + "; write " +
                      in_quotes(slashes));
}

}  // namespace

std::string read_name(const JsonValue& value) {
  const std::string name = value.text();
  const bool reserved = name.empty() || name == "." || name == "..";
  bool separated = false;
  for (char c : name) separated |= c == '/' || static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
  if (reserved || separated || name.size() > kMaxNameBytes)
    throw value.unexpected(
        "a name that can be used for files (1 to 200 bytes, no \"/\", no control characters, "
        "neither \".\" nor \"..\")");
  return name;
}

FilePath read_path(const JsonValue& value) {
  FilePath path;
  path.written = value.text();
  path.location = value.location();
  if (path.written.empty() || path.written.find('\0') != std::string::npos)
    throw value.unexpected("a path");
  const std::filesystem::path folder = std::filesystem::path(path.location.file).parent_path();
  path.resolved = (folder / path.written).string();
  refuse_backslashes(value, folder);
  return path;
}

AxisAngle read_rotation(const JsonValue& value) {
  JsonReader reader(value, "a rotation");
  AxisAngle rotation;
  rotation.axis = reader.required("axis").direction();
  rotation.angle = reader.required("angle_deg").angle();
  reader.finish();
  return rotation;
}

Motion read_motion(const JsonValue& value) {
  Motion motion;
  std::optional<double> before;
  for (const JsonValue& item : value.items(0, "array of keyframes")) {
    JsonReader reader(item, "a keyframe");
    Keyframe key;
    if (!motion.empty()) key.about = motion.back().about;
    before = key.time = later_than(before, reader.required("time"));
    if (const auto translate = reader.optional("translate"))
      key.translate = translate->vec3(dimension::length);
    if (const auto rotate = reader.optional("rotate")) key.rotate = read_rotation(*rotate);
    if (const auto about = reader.optional("about")) key.about = about->vec3(dimension::length);
    reader.finish();
    motion.push_back(key);
  }
  return motion;
}

Profile read_profile(const JsonValue& value) {
  Profile profile;
  std::optional<double> before;
  for (const JsonValue& item : value.items(1, "array of [time, factor] pairs")) {
    const auto pair = item.items(2, "array [time, factor]");
    if (pair.size() != 2) throw item.unexpected("a pair [time, factor]");
    before = later_than(before, pair[0]);
    profile.push_back({*before, pair[1].number()});
  }
  return profile;
}

}  // namespace bem
