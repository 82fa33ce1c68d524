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

std::size_t product(const Hdf5Dims& extents) {
  std::size_t count = 1;
  for (std::size_t n : extents) count *= n;
  return count;
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

std::vector<std::string> TrajectoryFile::children(const std::string& group) const {
  return has(group) ? file_.children(group) : std::vector<std::string>();
}

std::vector<std::string> TrajectoryFile::names(const std::string& group) const {
  std::vector<std::string> names = children(group);
  const auto index = [&](const std::string& name) {
    return integer(group + "/" + name, "index", INT64_MAX);
  };
  std::stable_sort(names.begin(), names.end(),
                   [&](const std::string& a, const std::string& b) { return index(a) < index(b); });
  return names;
}

std::size_t TrajectoryFile::row_count(const std::string& path) const {
  const Hdf5Dims dims = file_.dims(path);
  return dims.empty() ? 0 : dims[0];
}

Hdf5Dims TrajectoryFile::row_extents(const std::string& path) const {
  const Hdf5Dims dims = file_.dims(path);
  return dims.empty() ? dims : Hdf5Dims(dims.begin() + 1, dims.end());
}

std::string TrajectoryFile::text(const std::string& object, const std::string& attribute) const {
  return file_.has_attribute(object, attribute) ? file_.string_attribute(object, attribute) : "";
}

double TrajectoryFile::number(const std::string& object, const std::string& attribute) const {
  const double value = file_.double_attribute(object, attribute);
  check_finite(object + ": " + attribute, &value, 1);
  return value;
}

std::int64_t TrajectoryFile::integer(const std::string& object, const std::string& attribute,
                                     std::int64_t otherwise) const {
  return file_.has_attribute(object, attribute) ? file_.int_attribute(object, attribute)
                                                : otherwise;
}

std::vector<Triangle> TrajectoryFile::faces(const std::string& body) const {
  return triangles(series(body, "/faces"), vertices(body));
}

std::vector<Triangle> TrajectoryFile::triangles(const std::string& path,
                                                std::size_t vertices) const {
  file_.require_dataset(path, Hdf5Type::int32, {row_count(path), 3});
  const std::vector<std::int32_t> corners = file_.read<std::int32_t>(path);
  const auto count = static_cast<std::int64_t>(vertices);
  std::vector<Triangle> out(corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] < 0 || corners[i] >= count)
      throw Error(file_.error(), file_.path() + ": " + path + " has an index out of range");
    out[i / 3][i % 3] = corners[i];
  }
  return out;
}

/// What extents promise must be there: what is not in the file reads as zeros.
void TrajectoryFile::check_rows(const std::string& path, const Hdf5Dims& extents, std::size_t rows,
                                Hdf5Type type) const {
  const std::size_t found = row_count(path);
  Hdf5Dims expected{found};
  expected.insert(expected.end(), extents.begin(), extents.end());
  file_.require_dataset(path, type, expected);
  const std::size_t number = type == Hdf5Type::int32 ? 4 : 8;
  if (found < rows ||
      file_.stored_bytes(path) / number / std::max<std::size_t>(1, product(extents)) < rows)
    throw Error(file_.error(), file_.path() + ": " + path + " has fewer " +
                                   (rows == times_.size() ? std::string("frames than ") + kTimesPath
                                                          : "rows than are used"));
}

void TrajectoryFile::read(const std::string& body, const std::string& name, const Hdf5Dims& extents,
                          std::size_t frame, double* out) const {
  const std::string path = series(body, name);
  check_rows(path, extents, times_.size(), Hdf5Type::float64);
  file_.read_rows(path, frame, 1, out);
  check_finite(path, out, product(extents));
}

std::vector<double> TrajectoryFile::rows(const std::string& path, const Hdf5Dims& extents,
                                         std::size_t first, std::size_t end, Hdf5Type type) const {
  check_rows(path, extents, end, type);
  std::vector<double> out((end - first) * product(extents));
  if (!out.empty()) file_.read_rows(path, first, end - first, out.data());
  check_finite(path, out.data(), out.size());
  return out;
}

}  // namespace bem
