#include "recorded.hpp"

#include "output/trajectory_scene.hpp"

#include <map>
#include <sstream>

namespace bem {
namespace {

constexpr int kDigits = 10;
constexpr const char* kAxes[] = {"_x", "_y", "_z"};

/// Names of bodies and obstacles by their attribute "index".
std::map<int, std::string> surface_names(const TrajectoryFile& file) {
  std::map<int, std::string> names;
  for (const std::string group : {"/bodies", "/obstacles"})
    for (const std::string& name : file.names(group))
      names.emplace(static_cast<int>(file.integer(group + "/" + name, "index", -1)), name);
  return names;
}

}  // namespace

RecordedSeries::RecordedSeries(const TrajectoryFile& file, const std::vector<std::string>& bodies) {
  if (bodies.empty()) return;
  for (const std::string& name : file.children("/bodies/" + bodies[0] + "/series")) {
    const std::string path = "/series/" + name;
    const Hdf5Dims extents = file.row_extents("/bodies/" + bodies[0] + path);
    const std::size_t width = extents.empty() ? 1 : 3;
    const std::size_t first = columns_.size();
    for (std::size_t axis = 0; axis < width; ++axis)
      columns_.push_back({path.substr(1) + (width == 1 ? "" : kAxes[axis]), {}});
    for (const std::string& body : bodies) {
      const std::vector<double> all =
          file.all_frames("/bodies/" + body + path, width == 1 ? Hdf5Dims() : Hdf5Dims{3});
      for (std::size_t axis = 0; axis < width; ++axis) {
        std::vector<double> values;
        for (std::size_t i = axis; i < all.size(); i += width) values.push_back(all[i]);
        columns_[first + axis].values.push_back(std::move(values));
      }
    }
  }
}

std::string RecordedSeries::header() const {
  std::string text;
  for (const Column& c : columns_) text += "," + c.name;
  return text;
}

std::string RecordedSeries::row(std::size_t body, std::size_t frame) const {
  std::ostringstream text;
  text.precision(kDigits);
  for (const Column& c : columns_) text << "," << c.values[body][frame];
  return text.str();
}

std::string contacts_csv(const TrajectoryFile& file) {
  const std::vector<std::size_t> ends = contact_ends(file);
  if (ends.empty())
    throw Error(file.error(), file.path() +
                                  ": it has no contacts; write them with \"output\": {\"fields\": "
                                  "[\"contacts\"]}");
  const auto read = [&](const char* path, std::size_t width, Hdf5Type type) {
    return file.rows(path, {width}, 0, ends.back(), type);
  };
  const std::vector<double> points = read("/contacts/points", 3, Hdf5Type::float64),
                            normals = read("/contacts/normals", 3, Hdf5Type::float64),
                            forces = read("/contacts/forces", 3, Hdf5Type::float64),
                            pairs = read("/contacts/pairs", 2, Hdf5Type::int32);
  const std::map<int, std::string> names = surface_names(file);
  const auto name = [&](double index) {
    const auto found = names.find(static_cast<int>(index));
    return found == names.end() ? std::string("?") : found->second;
  };
  std::ostringstream text;
  text.precision(kDigits);
  text << "time,first,second,x,y,z,nx,ny,nz,fx,fy,fz\n";
  std::size_t row = 0;
  for (std::size_t frame = 0; frame < ends.size(); ++frame)
    for (; row < ends[frame]; ++row) {
      text << file.times()[frame] << "," << name(pairs[2 * row]) << "," << name(pairs[2 * row + 1]);
      for (const auto* values : {&points, &normals, &forces})
        for (std::size_t axis = 0; axis < 3; ++axis) text << "," << (*values)[3 * row + axis];
      text << "\n";
    }
  return text.str();
}

}  // namespace bem
