#include "output/hdf5_trajectory.hpp"

#include "base/error.hpp"
#include "files/file_io.hpp"
#include "output/trajectory_file.hpp"

#include <algorithm>
#include <utility>

namespace bem {
namespace {

constexpr std::size_t kPage = 4096;                // bytes that a disk writes anyway
constexpr std::size_t kVerticesPerChunk = 1024;    // 24 KiB
constexpr std::size_t kBookkeeping = 1 << 16;      // of HDF5 for some frames, at most
constexpr std::size_t kBookkeepingEach = 1 << 12;  // and for every chunk that they begin
constexpr std::size_t kMostWaiting = 1 << 25;      // bytes of frames

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
      reserve_(temporary_.path(), file_.path()) {
  records_ = {{kTrajectoryFile, 0, {}}};
  create_contents();
  if (kept > 0) {
    copy_frames(open_earlier(directory, bodies_, kept), kept);
    file_.sync();  // a checkpoint counts on them
  }
  temporary_.publish();
}

bool Hdf5Trajectory::is_output(const std::filesystem::path& path) {
  return path.filename() == kTrajectoryFile;
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

Hdf5Trajectory::~Hdf5Trajectory() {
  try {
    flush();
  } catch (const Error&) {
    // who wants to know calls close()
  }
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
    if (body.surface != TrajectorySurface::only)
      file_.set_attribute(
          path, kSurfaceAttribute,
          body.surface == TrajectorySurface::render ? kRenderSurface : "simulation");
  }
  std::rotate(series_.begin(), series_.begin() + 1, series_.end());
  file_.start_swmr();  // which hands all of it to the system
  for (Series& s : series_) s.dataset.emplace(file_, s.path);
}

void Hdf5Trajectory::create_series(const std::string& path, const Hdf5Dims& extents,
                                   const char* units) {
  Hdf5Dims dims{0};
  dims.insert(dims.end(), extents.begin(), extents.end());
  const Hdf5Dims chunks = chunk(extents);
  Series s{path};
  s.chunk_rows = chunks[0];
  s.chunk_bytes = chunks[0] * sizeof(double);
  for (std::size_t i = 0; i < extents.size(); ++i) {
    s.width *= extents[i];
    s.chunk_bytes *= (extents[i] + chunks[i + 1] - 1) / chunks[i + 1] * chunks[i + 1];
  }
  row_bytes_ += s.width * sizeof(double);
  series_.push_back(std::move(s));
  file_.create_dataset(path, Hdf5Type::float64, dims, {chunks, true});
  file_.set_attribute(path, "units", units);
}

/// In parts as large as what waits for being written.
void Hdf5Trajectory::copy_frames(const Hdf5File& earlier, std::size_t count) {
  const std::size_t part = std::max<std::size_t>(1, kMostWaiting / row_bytes_);
  while (frames_ < count) {
    const std::size_t rows = std::min(part, count - frames_);
    for (Series& s : series_) {
      s.rows.resize(rows * s.width);
      earlier.read_rows(s.path, frames_, rows, s.rows.data());
    }
    frames_ += rows;
    flush();
  }
}

void Hdf5Trajectory::write(const Frame& frame) {
  check_frame(bodies_, frame);
  require(frame.index == frames_, "frames are written in their order");
  auto next = series_.begin();
  const auto add = [&next](const double* values) {
    next->rows.insert(next->rows.end(), values, values + next->width);
    ++next;
  };
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyFrame& body = frame.bodies[i];
    const Mat3 rows = body.rotation.transpose();  // stored by columns, as the file wants the rows
    add(body.positions.data()->data());
    add(body.translation.data());
    add(rows.data());
    if (bodies_[i].tractions) add(body.tractions.data()->data());
  }
  add(&frame.time);
  ++frames_;
  add_frame(records_[0], frame);
  if (is_due()) flush();
}

bool Hdf5Trajectory::is_due() const {
  constexpr std::size_t kFewBodies = 32;
  return bodies_.size() <= kFewBodies || (frames_ - stored_) * row_bytes_ >= kMostWaiting ||
         Clock::now() >= due_;
}

/// Where the disk has no room for all frames that wait, those for which it has.
void Hdf5Trajectory::flush() {
  constexpr Clock::duration kLongWait = std::chrono::seconds(2);
  const Clock::time_point start = Clock::now();
  try {
    while (stored_ < frames_) store(frames_);
  } catch (const Error&) {
    for (Series& s : series_) s.rows.clear();
    frames_ = stored_;
    throw;
  }
  const Clock::time_point now = Clock::now();
  const Clock::duration spent = now - start;
  due_ = now + std::max(std::min(20 * spent, kLongWait), 10 * spent);
}

/// Writes waiting frames up to `end`, as far as the order of the file's pieces allows to do so
/// together.
void Hdf5Trajectory::store(std::size_t end) {
  // A piece of the times comes after those of all frames before and before those of all after.
  const std::size_t period = series_.back().chunk_rows, phase = stored_ % period;
  end = std::min(end, stored_ + (phase == 0 ? 1 : period - phase));
  try {
    reserve_.ensure(bytes_of(end));
  } catch (const Error&) {
    if (end == stored_ + 1) throw;
    return store(stored_ + 1);
  }
  store_together(end);
  for (Series& s : series_)
    s.rows.erase(s.rows.begin(),
                 s.rows.begin() + static_cast<std::ptrdiff_t>((end - stored_) * s.width));
  stored_ = end;
}

/// Pieces of the file are begun in the order of the frames, as if every frame were written alone.
void Hdf5Trajectory::store_together(std::size_t end) {
  const auto append = [&](Series& s, std::size_t frame) {
    const std::size_t rows = std::min(end - frame, s.chunk_rows - frame % s.chunk_rows);
    s.dataset->append(rows, s.rows.data() + (frame - stored_) * s.width);
  };
  for (std::size_t frame = stored_; frame < end; ++frame)
    for (std::size_t i = 0; i + 1 < series_.size(); ++i)
      if (frame == stored_ || frame % series_[i].chunk_rows == 0) append(series_[i], frame);
  // Only then the times: who sees them finds the rest.
  file_.flush();
  append(series_.back(), stored_);
  file_.flush();
}

/// What waiting frames up to `end` add to the file at most.
std::size_t Hdf5Trajectory::bytes_of(std::size_t end) const {
  std::size_t bytes = kBookkeeping;
  for (const Series& s : series_) {
    const std::size_t begun = (stored_ + s.chunk_rows - 1) / s.chunk_rows;
    bytes += ((end + s.chunk_rows - 1) / s.chunk_rows - begun) * (s.chunk_bytes + kBookkeepingEach);
  }
  return bytes;
}

void Hdf5Trajectory::sync() {
  flush();
  file_.sync();
  check_io(sync_folder(folder_of(file_.path())), file_.path());
}

void Hdf5Trajectory::close() {
  flush();
  series_.clear();
  file_.close();
  reserve_.release();
}

}  // namespace bem
