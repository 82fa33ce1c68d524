#include "files/hdf5_rows.hpp"

#include "files/hdf5_handle.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace bem {

static_assert(std::is_same_v<hsize_t, unsigned long long> && sizeof(hsize_t) == 8,
              "the header spells hsize_t without hdf5.h");

Hdf5Rows::Hdf5Rows(Hdf5File& file, std::string path)
    : file_(file.path()), path_(std::move(path)), error_(file.error_) {
  // Without a cache of its chunks a dataset takes its place in the file when it is written, not
  // when the file is flushed.
  const Hdf5Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_chunk_cache(access.get(), 0, 0, 0);
  id_ = H5Dopen2(file.id(), path_.c_str(), access.get());
  if (id_ < 0) fail("cannot be opened");
  const Hdf5Handle space(H5Dget_space(id_), H5Sclose), type(H5Dget_type(id_), H5Tclose);
  std::vector<hsize_t> dims(
      static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.get()))));
  if (!dims.empty()) H5Sget_simple_extent_dims(space.get(), dims.data(), nullptr);
  dims_.assign(dims.begin(), dims.end());
  const H5T_class_t kind = H5Tget_class(type.get());
  require(!dims_.empty() && (kind == H5T_FLOAT || kind == H5T_INTEGER),
          "rows of numbers are appended");
}

Hdf5Rows::Hdf5Rows(Hdf5Rows&& other) noexcept
    : file_(std::move(other.file_)),
      path_(std::move(other.path_)),
      error_(other.error_),
      id_(std::exchange(other.id_, -1)),
      dims_(std::move(other.dims_)) {}

Hdf5Rows& Hdf5Rows::operator=(Hdf5Rows&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(path_, other.path_);
  std::swap(error_, other.error_);
  std::swap(id_, other.id_);
  std::swap(dims_, other.dims_);
  return *this;
}

Hdf5Rows::~Hdf5Rows() {
  if (id_ < 0) return;
  silence_hdf5();
  H5Dclose(id_);
}

void Hdf5Rows::fail(const char* action) const {
  const std::string cause = hdf5_cause();
  throw Error(error_,
              file_ + ": " + path_ + ": " + action + (cause.empty() ? "" : " (" + cause + ")"));
}

void Hdf5Rows::append(std::size_t rows, const double* values) {
  if (rows == 0) return;
  silence_hdf5();
  std::vector<hsize_t> start(dims_.size(), 0), size(dims_.begin(), dims_.end()), part = size;
  start[0] = size[0];
  part[0] = rows;
  size[0] += rows;
  if (H5Dset_extent(id_, size.data()) < 0) fail("cannot be extended");
  dims_[0] = size[0];
  const int rank = static_cast<int>(size.size());
  const Hdf5Handle memory(H5Screate_simple(rank, part.data(), nullptr), H5Sclose);
  const Hdf5Handle space(H5Dget_space(id_), H5Sclose);
  H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, part.data(), nullptr);
  if (H5Dwrite(id_, H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT, values) < 0)
    fail("cannot be written");
}

}  // namespace bem
