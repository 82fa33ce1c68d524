#include "files/hdf5.hpp"
#include "files/hdf5_handle.hpp"

#include <algorithm>
#include <limits>

// The part of Hdf5File that deals with datasets.

namespace bem {
namespace {

using Extents = std::vector<hsize_t>;

Extents extents(const Hdf5Dims& dims) {
  return {dims.begin(), dims.end()};
}

hid_t file_type(Hdf5Type type) {
  switch (type) {
    case Hdf5Type::float64:
      return H5T_IEEE_F64LE;
    case Hdf5Type::float32:
      return H5T_IEEE_F32LE;
    case Hdf5Type::int32:
      return H5T_STD_I32LE;
    case Hdf5Type::int64:
      return H5T_STD_I64LE;
    case Hdf5Type::uint64:
      return H5T_STD_U64LE;
    case Hdf5Type::uint8:
      return H5T_STD_U8LE;
  }
  throw Error(ErrorCode::internal, "unknown Hdf5Type");
}

hid_t memory_type(Hdf5Type type) {
  switch (type) {
    case Hdf5Type::float64:
      return H5T_NATIVE_DOUBLE;
    case Hdf5Type::float32:
      return H5T_NATIVE_FLOAT;
    case Hdf5Type::int32:
      return H5T_NATIVE_INT32;
    case Hdf5Type::int64:
      return H5T_NATIVE_INT64;
    case Hdf5Type::uint64:
      return H5T_NATIVE_UINT64;
    case Hdf5Type::uint8:
      return H5T_NATIVE_UINT8;
  }
  throw Error(ErrorCode::internal, "unknown Hdf5Type");
}

/// Can every value of the one type be had in the other (but for rounding)?
bool convertible(hid_t stored, Hdf5Type wanted) {
  const bool to_float = wanted == Hdf5Type::float64 || wanted == Hdf5Type::float32;
  const H5T_class_t kind = H5Tget_class(stored);
  if (kind == H5T_FLOAT) return to_float;
  if (kind != H5T_INTEGER) return false;
  if (to_float) return true;
  const bool stored_signed = H5Tget_sign(stored) == H5T_SGN_2;
  const bool wanted_signed = wanted == Hdf5Type::int32 || wanted == Hdf5Type::int64;
  const std::size_t have = H5Tget_size(stored), want = H5Tget_size(memory_type(wanted));
  return stored_signed == wanted_signed ? have <= want : wanted_signed && have < want;
}

std::string to_text(const Hdf5Dims& dims) {
  std::string text = "[";
  for (std::size_t extent : dims) text += (text.size() > 1 ? ", " : "") + std::to_string(extent);
  return text + "]";
}

Hdf5Handle open_dataset(hid_t file, const std::string& path) {
  return {H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose};
}

Hdf5Handle dataset_creation(const Hdf5Layout& layout) {
  Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);
  const Extents chunk = extents(layout.chunk);
  if (!chunk.empty())
    require(H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data()) >= 0,
            "chunk of an HDF5 dataset");
  // Space taken at once lies in the order of creation, whatever the order of writing.
  if (!layout.extendible) H5Pset_alloc_time(creation.get(), H5D_ALLOC_TIME_EARLY);
  return creation;
}

/// A dataset with the selection of one part of it, in the file and as a dense array in memory.
struct Transfer {
  Hdf5Handle dataset, file_space, memory_space;
};

Transfer select_part(Hdf5Handle dataset, const Hdf5Dims& start, const Hdf5Dims& count) {
  Transfer t;
  t.dataset = std::move(dataset);
  t.file_space = {H5Dget_space(t.dataset.get()), H5Sclose};
  const Extents first = extents(start), size = extents(count);
  t.memory_space = {H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr),
                    H5Sclose};
  H5Sselect_hyperslab(t.file_space.get(), H5S_SELECT_SET, first.data(), nullptr, size.data(),
                      nullptr);
  return t;
}

}  // namespace

Hdf5Dims Hdf5File::dims(const std::string& path) const {
  const Hdf5Handle dataset = open_dataset(id(), path);
  if (!dataset) fail(path, "no such dataset");
  const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 0) fail_in_library(path, "cannot be read");
  Extents size(static_cast<std::size_t>(rank));
  if (rank > 0) H5Sget_simple_extent_dims(space.get(), size.data(), nullptr);
  return {size.begin(), size.end()};
}

Hdf5Type Hdf5File::type(const std::string& path) const {
  const Hdf5Handle dataset = open_dataset(id(), path);
  if (!dataset) fail(path, "no such dataset");
  const Hdf5Handle stored(H5Dget_type(dataset.get()), H5Tclose);
  const H5T_class_t kind = H5Tget_class(stored.get());
  for (Hdf5Type type : {Hdf5Type::float64, Hdf5Type::float32, Hdf5Type::int32, Hdf5Type::int64,
                        Hdf5Type::uint64, Hdf5Type::uint8}) {
    const hid_t native = memory_type(type);
    if (kind == H5Tget_class(native) && H5Tget_size(stored.get()) == H5Tget_size(native) &&
        (kind == H5T_FLOAT || H5Tget_sign(stored.get()) == H5Tget_sign(native)))
      return type;
  }
  fail(path, "holds numbers of an unexpected type");
}

void Hdf5File::require_dataset(const std::string& path, Hdf5Type type, const Hdf5Dims& dims) const {
  checked_count(path, dims, 1);
  if (this->type(path) != type) fail(path, "holds numbers of an unexpected type");
}

std::uint64_t Hdf5File::stored_bytes(const std::string& path) const {
  const Hdf5Handle dataset = open_dataset(id(), path);
  if (!dataset) fail(path, "no such dataset");
  return H5Dget_storage_size(dataset.get());
}

void Hdf5File::create_dataset(const std::string& path, Hdf5Type type, const Hdf5Dims& dims,
                              const Hdf5Layout& layout) {
  require(!dims.empty(), "an HDF5 dataset has extents");
  require(layout.chunk.empty() || layout.chunk.size() == dims.size(), "an HDF5 chunk has extents");
  require(!layout.extendible || !layout.chunk.empty(), "an extendible HDF5 dataset has chunks");
  const std::size_t slash = path.rfind('/');
  require(slash != std::string::npos, "the path of an HDF5 dataset is absolute");
  if (slash > 0) create_group(path.substr(0, slash));
  const Extents size = extents(dims);
  Extents largest = size;
  if (layout.extendible) largest[0] = H5S_UNLIMITED;
  const Hdf5Handle space(
      H5Screate_simple(static_cast<int>(size.size()), size.data(), largest.data()), H5Sclose);
  const Hdf5Handle creation = dataset_creation(layout);
  const Hdf5Handle made(H5Dcreate2(id(), path.c_str(), file_type(type), space.get(), H5P_DEFAULT,
                                   creation.get(), H5P_DEFAULT),
                        H5Dclose);
  if (!made) fail_in_library(path, "the dataset cannot be created");
}

void Hdf5File::extend_rows(const std::string& path, std::size_t rows) {
  Extents size = extents(dims(path));
  require(!size.empty(), "an HDF5 dataset that grows has rows");
  size[0] = rows;
  const Hdf5Handle dataset = open_dataset(id(), path);
  if (H5Dset_extent(dataset.get(), size.data()) < 0) fail_in_library(path, "cannot be extended");
}

void Hdf5File::check_size(const std::string& path, std::size_t size, const Hdf5Dims& extent) const {
  std::size_t product = 1;
  for (std::size_t n : extent) product *= n;
  if (product != size)
    throw Error(ErrorCode::internal, path_ + ": " + path + ": " + std::to_string(size) +
                                         " numbers for the extents " + to_text(extent));
}

std::size_t Hdf5File::checked_count(const std::string& path, const Hdf5Dims& expected,
                                    std::size_t bytes) const {
  const Hdf5Dims stored = dims(path);
  if (stored != expected)
    fail(path, "has the extents " + to_text(stored) + ", expected " + to_text(expected));
  std::size_t count = 1;
  for (std::size_t n : expected) {
    if (n > 0 && count > std::numeric_limits<std::size_t>::max() / bytes / n)
      fail(path, "has the impossible extents " + to_text(stored));
    count *= n;
  }
  return count;
}

void Hdf5File::check_part(const std::string& path, const Hdf5Dims& start,
                          const Hdf5Dims& count) const {
  const Hdf5Dims stored = dims(path);
  bool inside = start.size() == stored.size() && count.size() == stored.size();
  for (std::size_t k = 0; inside && k < stored.size(); ++k)
    inside = start[k] <= stored[k] && count[k] <= stored[k] - start[k];
  if (!inside)
    fail(path, "has the extents " + to_text(stored) + ", which do not hold a part of extents " +
                   to_text(count) + " at " + to_text(start));
}

void Hdf5File::write_raw(const std::string& path, Hdf5Type type, const Hdf5Dims& start,
                         const Hdf5Dims& count, const void* data) {
  check_part(path, start, count);
  if (!convertible(memory_type(type), this->type(path)))
    fail(path, "holds numbers of another type than those to be written");
  if (std::find(count.begin(), count.end(), 0) != count.end()) return;
  const Transfer t = select_part(open_dataset(id(), path), start, count);
  if (H5Dwrite(t.dataset.get(), memory_type(type), t.memory_space.get(), t.file_space.get(),
               H5P_DEFAULT, data) < 0)
    fail_in_library(path, "cannot be written");
  check_written();
}

void Hdf5File::read_raw(const std::string& path, Hdf5Type type, const Hdf5Dims& start,
                        const Hdf5Dims& count, void* out) const {
  check_part(path, start, count);
  Hdf5Handle dataset = open_dataset(id(), path);
  const Hdf5Handle stored(H5Dget_type(dataset.get()), H5Tclose);
  if (!convertible(stored.get(), type)) fail(path, "holds numbers of an unexpected type");
  if (std::find(count.begin(), count.end(), 0) != count.end()) return;
  const Transfer t = select_part(std::move(dataset), start, count);
  if (H5Dread(t.dataset.get(), memory_type(type), t.memory_space.get(), t.file_space.get(),
              H5P_DEFAULT, out) < 0)
    fail_in_library(path, "cannot be read");
}

Hdf5File::Part Hdf5File::part_of_rows(const std::string& path, std::size_t first,
                                      std::size_t rows) const {
  Part part;
  part.count = dims(path);
  part.start.assign(part.count.size(), 0);
  if (part.count.empty()) fail(path, "has no rows");
  part.start[0] = first;
  part.count[0] = rows;
  return part;
}

}  // namespace bem
