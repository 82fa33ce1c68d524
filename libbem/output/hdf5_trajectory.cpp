#include "output/hdf5_trajectory.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace bem {
namespace {

constexpr std::size_t kPage = 4096;              // bytes that a disk writes anyway
constexpr std::size_t kVerticesPerChunk = 1024;  // 24 KiB
constexpr std::size_t kBookkeeping = 1 << 16;    // of HDF5 for a frame, at most

static_assert(sizeof(Vec3) == 3 * sizeof(double), "vectors are stored without gaps");
static_assert(sizeof(Triangle) == 3 * sizeof(std::int32_t), "triangles are stored without gaps");

Hdf5File create_file(const std::string& directory) {
  Hdf5CreateOptions options;
  options.swmr = true;
  return Hdf5File::create(directory + "/" + kTrajectoryFile, options);
}

std::string group(const TrajectoryBody& body) {
  return "/bodies/" + body.name;
}

/// Chunk of a series whose frames have these extents. One frame of a part of the vertices: writing
/// a frame touches nothing old, and the path of a single vertex is found without reading whole
/// frames. Frames smaller than a page share one.
Hdf5Dims chunk(const Hdf5Dims& extents) {
  Hdf5Dims result{1};
  std::size_t bytes = sizeof(double);
  for (std::size_t n : extents) {
    result.push_back(std::clamp<std::size_t>(n, 1, kVerticesPerChunk));
    bytes *= result.back();
  }
  result[0] = std::max<std::size_t>(1, kPage / bytes);
  return result;
}

/// Puts the trajectory of an earlier run aside. One that is aside already was left there by a run
/// that ended before it had copied everything: it has all frames.
std::optional<TrajectoryFile> set_aside(const std::string& directory,
                                        const std::vector<TrajectoryBody>& bodies,
                                        std::size_t kept) {
  if (kept == 0) return std::nullopt;
  const std::string present = directory + "/" + kTrajectoryFile;
  const std::string aside = directory + "/" + kEarlierTrajectory;
  std::error_code code;
  const bool is_aside = std::filesystem::exists(aside, code);
  std::optional<TrajectoryFile> file;
  file.emplace(is_aside ? aside : present, ErrorCode::resources);
  bool fits = file->times().size() >= kept && file->body_count() == bodies.size();
  for (const TrajectoryBody& body : bodies)
    fits = fits && file->vertices(body.name) == body.vertices &&
           file->has_tractions(body.name) == body.tractions;
  if (!fits)
    throw Error(ErrorCode::resources, file->path() + ": does not hold the frames to go on from");
  if (!is_aside) std::filesystem::rename(present, aside, code);
  if (code)
    throw Error(ErrorCode::resources, aside + ": cannot be written (" + code.message() + ")");
  return file;
}

}  // namespace

Hdf5Trajectory::Hdf5Trajectory(const std::string& directory, std::vector<TrajectoryBody> bodies,
                               std::size_t kept)
    : bodies_((check_bodies(bodies), std::move(bodies))),
      earlier_(set_aside(directory, bodies_, kept)),
      file_(create_file(directory)),
      reserve_(file_.path()),
      frame_bytes_(kBookkeeping) {
  create_contents();
  if (!earlier_) return;
  copy_frames(*earlier_, kept);
  earlier_.reset();
  std::filesystem::remove(directory + "/" + kEarlierTrajectory);
}

void Hdf5Trajectory::create_contents() {
  file_.set_attribute("/", "format", "bem trajectory");
  file_.set_attribute("/", "version", 1);
  create_series("/time", {}, "s");
  for (const TrajectoryBody& body : bodies_) {
    const std::string path = group(body);
    file_.write(path + "/faces", body.triangles.empty() ? nullptr : body.triangles[0].data(),
                {body.triangles.size(), 3});
    file_.set_attribute(path + "/faces", "units", "1");
    create_series(path + "/positions", {body.vertices, 3}, "m");
    create_series(path + "/frame/translation", {3}, "m");
    create_series(path + "/frame/rotation", {3, 3}, "1");
    if (body.tractions) create_series(path + "/tractions", {body.vertices, 3}, "Pa");
  }
  file_.start_swmr();
  file_.flush();
}

void Hdf5Trajectory::create_series(const std::string& path, const Hdf5Dims& extents,
                                   const char* units) {
  Hdf5Dims dims{0};
  dims.insert(dims.end(), extents.begin(), extents.end());
  const Hdf5Dims chunks = chunk(extents);
  std::size_t bytes = chunks[0] * sizeof(double);
  for (std::size_t i = 0; i < extents.size(); ++i)
    bytes *= (extents[i] + chunks[i + 1] - 1) / chunks[i + 1] * chunks[i + 1];
  frame_bytes_ += bytes;
  file_.create_dataset(path, Hdf5Type::float64, dims, {chunks, true});
  file_.set_attribute(path, "units", units);
}

void Hdf5Trajectory::append(const std::string& path, const double* values) {
  file_.extend_rows(path, frames_ + 1);
  file_.write_rows(path, frames_, 1, values);
}

/// Frame by frame, as they were written: the bytes come out the same.
void Hdf5Trajectory::copy_frames(const TrajectoryFile& earlier, std::size_t count) {
  Frame frame;
  frame.bodies.resize(bodies_.size());
  for (; frame.index < count; ++frame.index) {
    frame.time = earlier.times()[frame.index];
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      BodyFrame& body = frame.bodies[i];
      const std::size_t vertices = bodies_[i].vertices;
      const auto read = [&](const std::string& name, const Hdf5Dims& extents, double* values) {
        earlier.read(bodies_[i].name, name, extents, frame.index, values);
      };
      body.positions.resize(vertices);
      read("/positions", {vertices, 3}, body.positions.data()->data());
      read("/frame/translation", {3}, body.translation.data());
      read("/frame/rotation", {3, 3}, body.rotation.data());
      body.rotation.transposeInPlace();  // rows are read as columns
      if (!bodies_[i].tractions) continue;
      body.tractions.resize(vertices);
      read("/tractions", {vertices, 3}, body.tractions.data()->data());
    }
    write(frame);
  }
}

void Hdf5Trajectory::write(const Frame& frame) {
  check_frame(bodies_, frame);
  require(frame.index == frames_, "frames are written in their order");
  reserve_.ensure(frame_bytes_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyFrame& body = frame.bodies[i];
    const std::string path = group(bodies_[i]);
    const Mat3 rows = body.rotation.transpose();  // stored by columns, as the file wants the rows
    append(path + "/positions", body.positions.data()->data());
    append(path + "/frame/translation", body.translation.data());
    append(path + "/frame/rotation", rows.data());
    if (bodies_[i].tractions) append(path + "/tractions", body.tractions.data()->data());
  }
  // Only then the time: who sees it finds the rest.
  file_.flush();
  append("/time", &frame.time);
  file_.flush();
  ++frames_;
}

void Hdf5Trajectory::close() {
  file_.close();
  reserve_.release();
}

}  // namespace bem
