#pragma once

#include "base/error.hpp"
#include "output/file_record.hpp"
#include "output/frame.hpp"
#include "support/temporary_folder.hpp"
#include "unit/mesh/mesh_test.hpp"

#include <algorithm>
#include <fstream>
#include <map>

namespace bem::test {

/// Two bodies, a tetrahedron with fields and series and a larger one without.
inline std::vector<TrajectoryBody> sample_bodies() {
  const TriangleMesh small = unit_tetrahedron();
  TrajectoryBody first{"small",
                       small.vertices.size(),
                       small.triangles,
                       {{"tractions", "Pa", 3}, {"von_mises", "Pa", 1}},
                       small.vertices};
  first.series = {{"momentum", "kg m/s", 3}, {"volume_ratio", "1", 1}};
  TrajectoryBody second{"large one", 3000, {{0, 1, 2}, {2999, 1, 0}}, {}};
  for (int v = 0; v < 3000; ++v) second.rest.push_back(Vec3(v, 2 - v, 0.25 * v));
  return {first, second};
}

/// The two bodies with a floor, a moving obstacle and contacts.
inline TrajectoryContents sample_contents() {
  TrajectoryContents out(sample_bodies());
  out.bodies[0].mass = 2.5;
  out.bodies[0].mesh_digest = "abc";
  out.bodies[1].index = 1;
  out.obstacles.push_back({"floor", ObstaclePlane{Vec3(0, -1, 0), Vec3(0, 1, 0)}});
  const TriangleMesh wall = unit_tetrahedron();
  out.obstacles.push_back({"wall", {}, wall.vertices, wall.triangles});
  for (std::size_t o = 0; o < 2; ++o) out.obstacles[o].index = 2 + o;
  out.contacts = true;
  out.program = "test 1.2";
  out.scene = "{\n  \"version\": 1\n}\n";
  out.time_step = 0.25;
  return out;
}

/// Contacts of a frame: none, one, many, ...
inline std::vector<ContactFrame> sample_contacts(std::size_t index) {
  std::vector<ContactFrame> out;
  const std::size_t count = index % 3 == 2 ? 500 + index : index % 3;
  for (std::size_t c = 0; c < count; ++c) {
    const double x = double(index) + 1e-3 * double(c);
    out.push_back({Vec3(x, 1, 2), Vec3(0, 1, 0), Vec3(-x, 3, 4), {int(c % 2), 2}});
  }
  return out;
}

/// A frame of all this whose every number is another one.
inline Frame sample_frame(std::size_t index) {
  const double t = 0.5 * double(index);
  Frame frame{index, 2 * index, t, {}};
  for (const TrajectoryBody& body : sample_bodies()) {
    BodyFrame state;
    const double b = double(body.vertices);
    for (std::size_t v = 0; v < body.vertices; ++v) {
      state.positions.push_back(Vec3(b, t, double(v) / 3));
    }
    const auto fill = [&](std::size_t count, double first) {
      std::vector<double> values(count);
      for (std::size_t i = 0; i < count; ++i) values[i] = first + t + double(i) / 7;
      return values;
    };
    for (const FrameQuantity& q : body.fields)
      state.fields.push_back(fill(body.vertices * q.components, 1e3 * double(q.components)));
    if (!body.series.empty()) state.series = fill(4, 0.5);
    state.frame.translation = Vec3(t, b, -1);
    state.frame.rotation << t, 1, 2, 3, 4, 5, 6, 7, b;
    frame.bodies.push_back(state);
  }
  frame.obstacles.resize(2);
  frame.obstacles[1].translation = Vec3(0, t, 7);
  frame.contacts = sample_contacts(index);
  return frame;
}

/// Names of what is in a folder, sorted.
inline std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// Relative names and contents of all files below a folder.
inline std::map<std::string, std::string> files_below(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[std::filesystem::relative(entry.path(), folder).string()] =
          read_file(entry.path().string());
  return files;
}

/// Writes seven frames; then the same in two runs, the first of which writes `first` frames of
/// which `kept` stay, and compares all bytes. The first run is not closed.
template <class Writer>
void check_going_on(std::size_t first, std::size_t kept) {
  const TemporaryFolder whole("whole"), parts("parts");
  Writer writer(whole.path(), sample_contents());
  for (std::size_t f = 0; f < 7; ++f) writer.write(sample_frame(f));
  writer.close();
  FileRecords records;
  {
    Writer earlier(parts.path(), sample_contents());
    for (std::size_t f = 0; f < first; ++f) {
      if (f == kept) records = earlier.records();
      earlier.write(sample_frame(f));
    }
    if (first == kept) records = earlier.records();
    earlier.sync();
  }
  // What a checkpoint says of the frames that stay is what is read back.
  CHECK(difference(records, Writer::read_records(parts.path(), sample_contents(), kept)).empty());
  Writer later(parts.path(), sample_contents(), kept);
  later.set_records(records);
  for (std::size_t f = kept; f < 7; ++f) later.write(sample_frame(f));
  later.close();
  CHECK(difference(writer.records(), later.records()).empty());
  const auto expected = files_below(whole.path()), found = files_below(parts.path());
  CHECK(expected.size() == found.size());
  for (const auto& [name, bytes] : expected) {
    INFO(name);
    CHECK((found.count(name) == 1 && found.at(name) == bytes));
  }
}

/// Every file of the output, damaged in its first frame or missing, is noticed by its name.
template <class Writer>
void check_damage() {
  const TemporaryFolder folder("damage");
  FileRecords records;
  {
    Writer writer(folder.path(), sample_contents());
    for (std::size_t f = 0; f < 3; ++f) writer.write(sample_frame(f));
    records = writer.records();
    writer.close();
  }
  const auto found = [&] {
    try {
      return difference(records, Writer::read_records(folder.path(), sample_contents(), 3));
    } catch (const Error& e) {
      CHECK(e.code() == ErrorCode::invalid_input);
      return std::string(e.what());
    }
  };
  CHECK(found().empty());
  for (const auto& [name, bytes] : files_below(folder.path())) {
    INFO(name);
    const std::string folder_of_file = name.substr(0, name.find('/') + 1);
    for (const std::string& damaged : {std::string(), bytes.substr(0, bytes.size() / 3)}) {
      std::ofstream(folder / name, std::ios::binary) << damaged;
      CHECK_THAT(found(), Catch::Matchers::Contains(folder_of_file));
    }
    std::filesystem::remove(folder / name);
    CHECK_THAT(found(), Catch::Matchers::Contains(folder_of_file));
    std::ofstream(folder / name, std::ios::binary) << bytes;
  }
  CHECK(found().empty());
}

/// Going on from more frames than there are is refused.
template <class Writer>
std::string refusal_to_go_on() {
  const TemporaryFolder folder("short");
  Writer(folder.path(), sample_contents()).write(sample_frame(0));
  return error_message(ErrorCode::invalid_input,
                       [&] { Writer(folder.path(), sample_contents(), 2); });
}

}  // namespace bem::test
