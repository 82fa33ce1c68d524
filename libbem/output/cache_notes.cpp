#include "output/cache_notes.hpp"

#include "base/error.hpp"
#include "files/pending_file.hpp"
#include "output/frame_files.hpp"
#include "output/trajectory_scene.hpp"

#include <nlohmann/json.hpp>

namespace bem {
namespace {

using Notes = nlohmann::ordered_json;

Notes numbers_of(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

Notes notes_of(const TrajectoryObstacle& obstacle) {
  Notes out{{"name", obstacle.name}};
  if (obstacle.plane) {
    out["point"] = numbers_of(obstacle.plane->point);
    out["normal"] = numbers_of(obstacle.plane->normal);
    return out;
  }
  out["vertices"] = Notes::array();
  for (const Vec3& v : obstacle.vertices) out["vertices"].push_back(numbers_of(v));
  out["faces"] = obstacle.triangles;
  return out;
}

Notes notes_of(const RigidPlace& place) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(place.rotation).normalized();
  Notes out = numbers_of(place.translation);
  for (double x : {q.w(), q.x(), q.y(), q.z()}) out.push_back(x);
  return out;
}

std::string line_of(const Notes& notes) {
  return notes.dump(-1, ' ', false, Notes::error_handler_t::replace) + "\n";
}

std::string first_line(const TrajectoryContents& contents) {
  Notes out{{"program", contents.program},
            {"up", numbers_of(up_of_scene(contents.scene))},
            {"bodies", Notes::array()},
            {"obstacles", Notes::array()}};
  for (const TrajectoryBody& body : contents.bodies) out["bodies"].push_back(body.name);
  for (const TrajectoryObstacle& obstacle : contents.obstacles)
    out["obstacles"].push_back(notes_of(obstacle));
  return line_of(out);
}

std::string joined(const std::string& first, const std::vector<std::string>& lines) {
  std::string out = first;
  for (const std::string& line : lines) out += line;
  return out;
}

/// One that replaces another is on the disk first: a checkpoint may count on it.
GrowingFile create_notes(const std::string& path, const std::string& start) {
  PendingFile(path).commit(start);
  return GrowingFile(path);
}

}  // namespace

CacheNotes::CacheNotes(const std::string& path, const TrajectoryContents& contents,
                       std::size_t kept)
    : CacheNotes(path, joined(first_line(contents), read(path, contents, kept))) {
  for (const TrajectoryObstacle& obstacle : contents.obstacles)
    is_plane_.push_back(obstacle.plane.has_value());
}

CacheNotes::CacheNotes(const std::string& path, const std::string& start)
    : end_(start.size()), file_(create_notes(path, start)) {}

std::string CacheNotes::add(const Frame& frame) {
  Notes places = Notes::array();
  for (std::size_t o = 0; o < is_plane_.size(); ++o)
    places.push_back(is_plane_[o] ? Notes() : notes_of(frame.obstacles[o]));
  std::string line = line_of({{"time", frame.time}, {"places", places}});
  file_.write(end_, line);
  end_ += line.size();
  return line;
}

std::vector<std::string> CacheNotes::read(const std::string& path,
                                          const TrajectoryContents& contents, std::size_t frames) {
  std::vector<std::string> lines;
  if (frames == 0) return lines;
  const std::string text = file_contents(path), first = first_line(contents);
  std::size_t begin = first.size();
  bool ours = text.compare(0, begin, first) == 0;
  while (ours && lines.size() < frames) {
    const std::size_t newline = text.find('\n', begin);
    ours = newline != std::string::npos;
    if (!ours) break;
    lines.push_back(text.substr(begin, newline + 1 - begin));
    begin = newline + 1;
  }
  if (!ours)
    throw Error(ErrorCode::invalid_input, path + ": does not hold the frames to go on from");
  return lines;
}

}  // namespace bem
