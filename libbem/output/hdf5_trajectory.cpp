#include "output/hdf5_trajectory.hpp"

#include "base/error.hpp"
#include "base/file_io.hpp"
#include "output/trajectory_file.hpp"

#include <algorithm>
#include <utility>

namespace bem {
namespace {

constexpr std::size_t kPage = 4096;              // bytes that a disk writes anyway
constexpr std::size_t kVerticesPerChunk = 1024;  // 24 KiB
constexpr std::size_t kBookkeeping = 1 << 16;    // of HDF5 for a frame, at most

static_assert(sizeof(Vec3) == 3 * sizeof(double), "vectors are stored without gaps");
static_assert(sizeof(Triangle) == 3 * sizeof(std::int32_t), "triangles are stored without gaps");

Hdf5File create_file(const std::string& path, const std::string& name) {
  Hdf5CreateOptions options;
  options.name = name;
  options.swmr = true;
  return Hdf5File::create(path, options);
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

/// The trajectory of an earlier run, which must hold some frames of the bodies.
Hdf5File open_earlier(const std::string& directory, const std::vector<TrajectoryBody>& bodies,
                      std::size_t frames) {
  const std::string path = directory + "/" + kTrajectoryFile;
  {
    const TrajectoryFile earlier(path, ErrorCode::invalid_input);  // checks what is in it
    bool fits = earlier.times().size() >= frames && earlier.body_count() == bodies.size();
    for (const TrajectoryBody& body : bodies)
      fits = fits && earlier.vertices(body.name) == body.vertices &&
             earlier.has_tractions(body.name) == body.tractions;
    if (!fits)
      throw Error(ErrorCode::invalid_input, path + ": does not hold the frames to go on from");
  }
  return Hdf5File::open_growing(path, ErrorCode::invalid_input);
}

Frame read_frame(const Hdf5File& file, const std::vector<TrajectoryBody>& bodies,
                 std::size_t index) {
  Frame frame;
  frame.index = index;
  file.read_rows("/time", index, 1, &frame.time);
  for (const TrajectoryBody& b : bodies) {
    BodyFrame& body = frame.bodies.emplace_back();
    const std::string path = group(b);
    const auto read = [&](const std::string& name, double* values) {
      file.read_rows(path + name, index, 1, values);
    };
    body.positions.resize(b.vertices);
    read("/positions", body.positions.data()->data());
    read("/frame/translation", body.translation.data());
    read("/frame/rotation", body.rotation.data());
    body.rotation.transposeInPlace();  // rows are read as columns
    if (!b.tractions) continue;
    body.tractions.resize(b.vertices);
    read("/tractions", body.tractions.data()->data());
  }
  return frame;
}

void add_numbers(FileRecord& record, const double* values, std::size_t count) {
  record.add({reinterpret_cast<const char*>(values), count * sizeof(double)});
}

/// The numbers of a frame, whatever HDF5 makes of them in the file.
void add_frame(FileRecord& record, const Frame& frame) {
  add_numbers(record, &frame.time, 1);
  for (const BodyFrame& body : frame.bodies) {
    add_numbers(record, body.positions.data()->data(), 3 * body.positions.size());
    add_numbers(record, body.translation.data(), 3);
    add_numbers(record, body.rotation.data(), 9);
    add_numbers(record, body.tractions.data()->data(), 3 * body.tractions.size());
  }
}

}  // namespace

Hdf5Trajectory::Hdf5Trajectory(const std::string& directory, std::vector<TrajectoryBody> bodies,
                               std::size_t kept)
    : bodies_((check_bodies(bodies), std::move(bodies))),
      temporary_(directory + "/" + kTrajectoryFile),
      file_(create_file(temporary_.path(), directory + "/" + kTrajectoryFile)),
      reserve_(temporary_.path(), file_.path()),
      frame_bytes_(kBookkeeping) {
  records_ = {{kTrajectoryFile, 0, {}}};
  create_contents();
  if (kept > 0) {
    // Frame by frame, as they were written: the bytes come out the same.
    const Hdf5File earlier = open_earlier(directory, bodies_, kept);
    while (frames_ < kept) write(read_frame(earlier, bodies_, frames_));
    file_.sync();  // a checkpoint counts on them
  }
  temporary_.publish();
}

FileRecords Hdf5Trajectory::read_records(const std::string& directory,
                                         const std::vector<TrajectoryBody>& bodies,
                                         std::size_t frames) {
  FileRecords records{{kTrajectoryFile, 0, {}}};
  if (frames == 0) return records;
  const Hdf5File file = open_earlier(directory, bodies, frames);
  for (std::size_t i = 0; i < frames; ++i) add_frame(records[0], read_frame(file, bodies, i));
  return records;
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
  add_frame(records_[0], frame);
}

void Hdf5Trajectory::sync() {
  file_.sync();
  check_io(sync_folder(folder_of(file_.path())), file_.path());
}

void Hdf5Trajectory::close() {
  file_.close();
  reserve_.release();
}

}  // namespace bem
