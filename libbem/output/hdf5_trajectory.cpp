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

Hdf5File create_file(const std::string& path, const std::string& name) {
  Hdf5CreateOptions options;
  options.name = name;
  options.swmr = true;
  return Hdf5File::create(path, options);
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

/// The trajectory of an earlier run, which must hold some frames of these contents.
Hdf5File open_earlier(const std::string& directory, const std::vector<TrajectoryDataset>& datasets,
                      std::size_t frames) {
  const std::string path = directory + "/" + kTrajectoryFile;
  // closed before the file is opened again: HDF5 would share one open file between the two
  const std::size_t found = TrajectoryFile(path, ErrorCode::invalid_input).times().size();
  Hdf5File file = Hdf5File::open_growing(path, ErrorCode::invalid_input);
  const auto fits = [&](const TrajectoryDataset& d) {
    if (!file.exists(d.path) || file.type(d.path) != d.type) return false;
    Hdf5Dims dims = file.dims(d.path);
    if (dims.empty() || (!d.by_contact && dims[0] < frames)) return false;
    dims.erase(dims.begin());
    return dims == d.extents;
  };
  if (found < frames || !std::all_of(datasets.begin(), datasets.end(), fits))
    throw Error(ErrorCode::invalid_input, path + ": does not hold the frames to go on from");
  return file;
}

/// For each of the first frames: how many rows it has by contact.
std::vector<std::size_t> contact_counts(const Hdf5File& file, std::size_t frames) {
  std::vector<std::size_t> out(frames, 0);
  if (frames == 0 || !file.exists(kContactCountsPath)) return out;
  std::vector<double> counts(frames);
  file.read_rows(kContactCountsPath, 0, frames, counts.data());
  for (std::size_t f = 0; f < frames; ++f) out[f] = static_cast<std::size_t>(counts[f]);
  return out;
}

/// Adds rows of a file to those of a dataset.
void read_rows(const Hdf5File& file, const TrajectoryDataset& dataset, std::size_t first,
               std::size_t count, std::vector<double>& to) {
  const std::size_t begin = to.size();
  to.resize(begin + count * dataset.width());
  if (count > 0) file.read_rows(dataset.path, first, count, to.data() + begin);
}

/// Adds the numbers of a vector from `begin` on.
void add_numbers(FileRecord& record, const std::vector<double>& values, std::size_t begin = 0) {
  record.add({reinterpret_cast<const char*>(values.data() + begin),
              (values.size() - begin) * sizeof(double)});
}

}  // namespace

/// Writes waiting rows up to one of them.
void Hdf5Trajectory::Series::append(std::size_t end) {
  dataset->append(end - stored, rows.data() + (stored - first) * layout.width());
  stored = end;
}

void Hdf5Trajectory::Series::forget_stored() {
  rows.erase(rows.begin(),
             rows.begin() + static_cast<std::ptrdiff_t>((stored - first) * layout.width()));
  first = stored;
}

/// What has been added to the rows belongs to a frame.
void Hdf5Trajectory::Series::end_frame() {
  ends.push_back(first + rows.size() / layout.width());
}

Hdf5Trajectory::Hdf5Trajectory(const std::string& directory, TrajectoryContents contents,
                               std::size_t kept)
    : contents_((check_contents(contents), std::move(contents))),
      temporary_(directory + "/" + kTrajectoryFile),
      file_(create_file(temporary_.path(), directory + "/" + kTrajectoryFile)),
      reserve_(temporary_.path(), file_.path()) {
  records_ = {{kTrajectoryFile, 0, {}}};
  create_datasets();
  if (kept > 0) {
    copy_frames(open_earlier(directory, trajectory_datasets(contents_), kept), kept);
    file_.sync();  // a checkpoint counts on them
  }
  temporary_.publish();
}

bool Hdf5Trajectory::is_output(const std::filesystem::path& path) {
  return path.filename() == kTrajectoryFile;
}

FileRecords Hdf5Trajectory::read_records(const std::string& directory,
                                         const TrajectoryContents& contents, std::size_t frames) {
  FileRecords records{{kTrajectoryFile, 0, {}}};
  if (frames == 0) return records;
  const std::vector<TrajectoryDataset> datasets = trajectory_datasets(contents);
  const Hdf5File file = open_earlier(directory, datasets, frames);
  const std::vector<std::size_t> contacts = contact_counts(file, frames);
  std::size_t contact = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    for (const TrajectoryDataset& d : datasets) {
      std::vector<double> rows;
      read_rows(file, d, d.by_contact ? contact : f, d.by_contact ? contacts[f] : 1, rows);
      add_numbers(records[0], rows);
    }
    contact += contacts[f];
  }
  return records;
}

Hdf5Trajectory::~Hdf5Trajectory() {
  try {
    flush();
  } catch (const Error&) {
    // who wants to know calls close()
  }
}

void Hdf5Trajectory::create_datasets() {
  write_contents(file_, contents_);
  for (TrajectoryDataset& d : trajectory_datasets(contents_)) {
    const Hdf5Dims chunks = chunk(d.extents);
    std::size_t bytes = chunks[0] * sizeof(double);
    for (std::size_t i = 0; i < d.extents.size(); ++i)
      bytes *= (d.extents[i] + chunks[i + 1] - 1) / chunks[i + 1] * chunks[i + 1];
    Hdf5Dims dims{0};
    dims.insert(dims.end(), d.extents.begin(), d.extents.end());
    file_.create_dataset(d.path, d.type, dims, {chunks, true});
    file_.set_attribute(d.path, "units", d.units);
    series_.push_back({std::move(d), chunks[0], bytes});
  }
  file_.start_swmr();  // which hands all of it to the system
  for (Series& s : series_) s.dataset.emplace(file_, s.layout.path);
}

void Hdf5Trajectory::copy_frames(const Hdf5File& earlier, std::size_t count) {
  const std::vector<std::size_t> contacts = contact_counts(earlier, count);
  for (; frames_ < count; ++frames_) {
    for (Series& s : series_) {
      read_rows(earlier, s.layout, s.end(), s.layout.by_contact ? contacts[frames_] : 1, s.rows);
      s.end_frame();
    }
    if (waiting_bytes() >= kMostWaiting) flush();
  }
  flush();
}

void Hdf5Trajectory::write(const Frame& frame) {
  check_frame(contents_, frame);
  require(frame.index == frames_, "frames are written in their order");
  for (Series& s : series_) {
    const std::size_t begin = s.rows.size();
    s.layout.append(frame, s.rows);
    add_numbers(records_[0], s.rows, begin);
    s.end_frame();
  }
  ++frames_;
  if (is_due()) flush();
}

std::size_t Hdf5Trajectory::waiting_bytes() const {
  std::size_t bytes = 0;
  for (const Series& s : series_) bytes += s.rows.size() * sizeof(double);
  return bytes;
}

bool Hdf5Trajectory::is_due() const {
  constexpr std::size_t kFewBodies = 32;
  return contents_.bodies.size() <= kFewBodies || waiting_bytes() >= kMostWaiting ||
         Clock::now() >= due_;
}

/// Where the disk has no room for all frames that wait, those for which it has.
void Hdf5Trajectory::flush() {
  constexpr Clock::duration kLongWait = std::chrono::seconds(2);
  const Clock::time_point start = Clock::now();
  try {
    while (stored_ < frames_) store(frames_);
  } catch (const Error&) {
    for (Series& s : series_) {
      s.rows.clear();
      s.ends.clear();
      s.first = s.stored;
    }
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
  for (Series& s : series_) {
    s.forget_stored();
    s.ends.erase(s.ends.begin(), s.ends.begin() + static_cast<std::ptrdiff_t>(end - stored_));
  }
  stored_ = end;
}

/// Pieces of the file are begun in the order of the frames, as if every frame were written alone.
void Hdf5Trajectory::store_together(std::size_t end) {
  for (std::size_t frame = 0; frame < end - stored_; ++frame)
    for (std::size_t i = 0; i + 1 < series_.size(); ++i) {
      Series& s = series_[i];
      if (s.stored >= s.ends[frame]) continue;
      s.append(std::min(s.ends[end - stored_ - 1], s.pieces(s.ends[frame]) * s.chunk_rows));
    }
  // Only then the times: who sees them finds the rest.
  file_.flush();
  series_.back().append(end);
  file_.flush();
}

/// What waiting frames up to `end` add to the file at most.
std::size_t Hdf5Trajectory::bytes_of(std::size_t end) const {
  std::size_t bytes = kBookkeeping;
  for (const Series& s : series_)
    bytes += (s.pieces(s.ends[end - stored_ - 1]) - s.pieces(s.stored)) *
             (s.chunk_bytes + kBookkeepingEach);
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
