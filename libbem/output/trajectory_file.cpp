#include "output/trajectory_file.hpp"

#include "base/finite.hpp"
#include "files/file_check.hpp"
#include "output/trajectory_layout.hpp"

#include <algorithm>
#include <functional>

namespace bem {
namespace {

Hdf5File open_checked(const std::string& path, ErrorCode error) {
  check_hdf5_file(path, Hdf5Storage::growing, error);
  return Hdf5File::open_growing(path, error);
}

}  // namespace

TrajectoryFile::TrajectoryFile(const std::string& path, ErrorCode error)
    : file_(open_checked(path, error)) {
  const Hdf5Dims dims = file_.dims(kTimesPath);
  file_.require_dataset(kTimesPath, Hdf5Type::float64, {dims.empty() ? 0 : dims[0]});
  times_ = file_.read<double>(kTimesPath);
  check_finite(kTimesPath, times_.data(), times_.size());
  if (std::adjacent_find(times_.begin(), times_.end(), std::greater_equal<>()) != times_.end())
    throw Error(error, path + ": " + kTimesPath + " does not ascend");
}

std::string TrajectoryFile::series(const std::string& body, const std::string& name) const {
  return "/bodies/" + body + name;
}

void TrajectoryFile::check_finite(const std::string& path, const double* numbers,
                                  std::size_t count) const {
  if (!all_finite(numbers, count))
    throw Error(file_.error(), file_.path() + ": " + path + " has a number that is not finite");
}

bool TrajectoryFile::has_body(const std::string& body) const {
  return file_.exists("/bodies/" + body);
}

bool TrajectoryFile::is_render_mesh(const std::string& body) const {
  const std::string group = "/bodies/" + body;
  return has_body(body) && file_.has_attribute(group, kSurfaceAttribute) &&
         file_.string_attribute(group, kSurfaceAttribute) == kRenderSurface;
}

std::size_t TrajectoryFile::vertices(const std::string& body) const {
  const Hdf5Dims dims = file_.dims(series(body, "/positions"));
  return dims.size() == 3 ? dims[1] : 0;
}

bool TrajectoryFile::has(const std::string& body, const std::string& name) const {
  return file_.exists(series(body, name));
}

std::vector<std::array<int, 3>> TrajectoryFile::faces(const std::string& body) const {
  const std::string path = series(body, "/faces");
  const Hdf5Dims dims = file_.dims(path);
  file_.require_dataset(path, Hdf5Type::int32, {dims.empty() ? 0 : dims[0], 3});
  const std::vector<std::int32_t> corners = file_.read<std::int32_t>(path);
  const auto count = static_cast<std::int64_t>(vertices(body));
  std::vector<std::array<int, 3>> out(corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] < 0 || corners[i] >= count)
      throw Error(file_.error(), file_.path() + ": " + path + " has an index out of range");
    out[i / 3][i % 3] = corners[i];
  }
  return out;
}

/// All frames that the times promise must be there: what is not in the file reads as zeros.
void TrajectoryFile::read(const std::string& body, const std::string& name, const Hdf5Dims& extents,
                          std::size_t frame, double* out) const {
  const std::string path = series(body, name);
  const Hdf5Dims found = file_.dims(path);
  Hdf5Dims expected{found.empty() ? 0 : found[0]};
  expected.insert(expected.end(), extents.begin(), extents.end());
  file_.require_dataset(path, Hdf5Type::float64, expected);
  std::size_t count = 1;
  for (std::size_t n : extents) count *= n;
  if (found[0] < times_.size() ||
      file_.stored_bytes(path) / sizeof(double) / std::max<std::size_t>(1, count) < times_.size())
    throw Error(file_.error(), file_.path() + ": " + path + " has fewer frames than " + kTimesPath);
  file_.read_rows(path, frame, 1, out);
  check_finite(path, out, count);
}

}  // namespace bem
