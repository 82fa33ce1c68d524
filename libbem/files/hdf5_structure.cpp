#include "files/hdf5_structure.hpp"

#include "files/file_io.hpp"
#include "files/hdf5_driver.hpp"
#include "files/hdf5_handle.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <set>
#include <vector>

namespace bem {
namespace {

constexpr int kDeepestGroup = 8;                 // groups in each other
constexpr int kMostExtents = 4;                  // of a dataset
constexpr std::uint64_t kMostText = 1 << 16;     // bytes of a text attribute
constexpr std::uint64_t kMostChunk = 1 << 20;    // bytes
constexpr std::uint64_t kPieceBytes = 16 << 20;  // that are read together

/// What is wrong, and where.
struct Fault {
  std::string text;
};

[[noreturn]] void refuse(const std::string& object, const std::string& what) {
  throw Fault{object + " " + what};
}

struct Link {
  std::string name;
  H5L_type_t type;
};

herr_t collect_link(hid_t, const char* name, const H5L_info_t* info, void* out) {
  static_cast<std::vector<Link>*>(out)->push_back({name, info->type});
  return 0;
}

herr_t collect_name(hid_t, const char* name, const H5A_info_t*, void* out) {
  static_cast<std::vector<std::string>*>(out)->push_back(name);
  return 0;
}

bool is_one_of(hid_t type, std::initializer_list<hid_t> types) {
  return std::any_of(types.begin(), types.end(),
                     [type](hid_t other) { return H5Tequal(type, other) > 0; });
}

/// a * b, or the largest number if that is beyond it.
std::uint64_t product(std::uint64_t a, std::uint64_t b) {
  std::uint64_t result = 0;
  return __builtin_mul_overflow(a, b, &result) ? UINT64_MAX : result;
}

class Walk {
 public:
  Walk(std::uint64_t file_bytes, Hdf5Storage storage)
      : file_bytes_(file_bytes), unclaimed_(file_bytes), storage_(storage) {}

  void object(hid_t id, const std::string& path, int depth) {
    H5O_info_t info;
    if (H5Oget_info2(id, &info, H5O_INFO_BASIC) < 0) refuse(path, "cannot be read");
    if (!seen_.insert(info.addr).second || info.rc != 1)
      refuse(path, "is linked to from several places");
    attributes(id, path);
    if (info.type == H5O_TYPE_GROUP)
      group(id, path, depth);
    else if (info.type == H5O_TYPE_DATASET)
      dataset(id, path);
    else
      refuse(path, "is neither a group nor a dataset");
  }

 private:
  void group(hid_t id, const std::string& path, int depth) {
    if (depth > kDeepestGroup) refuse(path, "is too deep");
    std::vector<Link> links;
    if (H5Literate(id, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_link, &links) < 0)
      refuse(path, "cannot be listed");
    for (const Link& link : links) {
      const std::string inner = (path == "/" ? path : path + "/") + link.name;
      if (link.type != H5L_TYPE_HARD) refuse(inner, "is a link to another place");
      const Hdf5Handle child(H5Oopen(id, link.name.c_str(), H5P_DEFAULT), H5Oclose);
      if (!child) refuse(inner, "cannot be opened");
      object(child.get(), inner, depth + 1);
    }
  }

  void attributes(hid_t id, const std::string& path) const {
    std::vector<std::string> names;
    if (H5Aiterate2(id, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names) < 0)
      refuse(path, "has attributes that cannot be listed");
    for (const std::string& name : names) {
      const Hdf5Handle attribute(H5Aopen(id, name.c_str(), H5P_DEFAULT), H5Aclose);
      if (!attribute || !is_known(attribute))
        refuse(path, "has the attribute \"" + name + "\", which is no text or number");
    }
  }

  static bool is_known(const Hdf5Handle& attribute) {
    const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose);
    const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose);
    if (!type || !space || H5Sget_simple_extent_type(space.get()) != H5S_SCALAR) return false;
    if (H5Tget_class(type.get()) != H5T_STRING)
      return is_one_of(type.get(), {H5T_IEEE_F64LE, H5T_STD_I64LE});
    if (H5Tis_variable_str(type.get()) <= 0) return false;
    char* text = nullptr;
    const bool read = H5Aread(attribute.get(), type.get(), &text) >= 0;
    const bool good = read && std::string(text ? text : "").size() <= kMostText;
    if (text) H5free_memory(text);
    return good;
  }

  void dataset(hid_t id, const std::string& path) {
    const Hdf5Handle type(H5Dget_type(id), H5Tclose);
    if (!type || !is_one_of(type.get(), {H5T_IEEE_F64LE, H5T_IEEE_F32LE, H5T_STD_I32LE,
                                         H5T_STD_I64LE, H5T_STD_U64LE, H5T_STD_U8LE}))
      refuse(path, "holds numbers of an unexpected type");
    const Hdf5Handle creation(H5Dget_create_plist(id), H5Pclose);
    const H5D_layout_t layout = creation ? H5Pget_layout(creation.get()) : H5D_LAYOUT_ERROR;
    const bool chunked = layout == H5D_CHUNKED && storage_ == Hdf5Storage::growing;
    if (!creation || (layout != H5D_CONTIGUOUS && !chunked))
      refuse(path, "is stored in an unexpected way");
    if (H5Pget_external_count(creation.get()) != 0) refuse(path, "is stored in other files");
    if (H5Pget_nfilters(creation.get()) != 0) refuse(path, "is stored with a filter");
    const std::vector<hsize_t> extents = extents_of(id, path);
    std::uint64_t bytes = H5Tget_size(type.get());
    for (hsize_t n : extents) bytes = product(bytes, n);
    if (chunked)
      chunks(id, path, creation, extents, bytes, H5Tget_size(type.get()));
    else
      whole(id, path, bytes);
  }

  static std::vector<hsize_t> extents_of(hid_t dataset, const std::string& path) {
    const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
    const int rank = space && H5Sget_simple_extent_type(space.get()) == H5S_SIMPLE
                         ? H5Sget_simple_extent_ndims(space.get())
                         : 0;
    if (rank < 1 || rank > kMostExtents) refuse(path, "has unexpected extents");
    std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr);
    return extents;
  }

  /// No two datasets share their place: all of them together are no larger than the file.
  void claim(const std::string& path, std::uint64_t bytes) {
    if (bytes > unclaimed_) refuse(path, "promises more numbers than the file has room for");
    unclaimed_ -= bytes;
  }

  void whole(hid_t id, const std::string& path, std::uint64_t bytes) {
    if (bytes == 0) return;
    claim(path, bytes);
    const haddr_t place = H5Dget_offset(id);
    if (H5Dget_storage_size(id) != bytes || place == HADDR_UNDEF || place > file_bytes_ ||
        bytes > file_bytes_ - place)
      refuse(path, "promises more numbers than the file has");
  }

  /// Of a file whose writer was killed the last row may be missing.
  void chunks(hid_t id, const std::string& path, const Hdf5Handle& creation,
              const std::vector<hsize_t>& extents, std::uint64_t bytes, std::uint64_t entry) {
    hsize_t chunk[kMostExtents] = {};
    const int rank = H5Pget_chunk(creation.get(), kMostExtents, chunk);
    std::uint64_t chunk_bytes = entry;
    for (int k = 0; k < rank; ++k) chunk_bytes = product(chunk_bytes, chunk[k]);
    if (rank != static_cast<int>(extents.size()) || chunk_bytes > kMostChunk)
      refuse(path, "has unexpected chunks");
    if (bytes == 0) return;
    const std::uint64_t row = bytes / extents[0], stored = H5Dget_storage_size(id);
    if (bytes == UINT64_MAX || row > file_bytes_ || bytes - row > stored)
      refuse(path, "promises more numbers than the file has");
    claim(path, bytes - row);
    read_all(id, path, extents, row);
  }

  /// The index of the chunks is part of the structure: the library follows it when it reads.
  static void read_all(hid_t id, const std::string& path, const std::vector<hsize_t>& extents,
                       std::uint64_t row) {
    const hsize_t most = std::max<std::uint64_t>(1, kPieceBytes / row);
    std::vector<hsize_t> start(extents.size(), 0), count = extents;
    const Hdf5Handle type(H5Dget_type(id), H5Tclose), space(H5Dget_space(id), H5Sclose);
    std::vector<char> piece(std::min(most, extents[0]) * row);
    for (start[0] = 0; start[0] < extents[0]; start[0] += count[0]) {
      count[0] = std::min(most, extents[0] - start[0]);
      const Hdf5Handle memory(
          H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
      if (H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(),
                              nullptr) < 0 ||
          H5Dread(id, type.get(), memory.get(), space.get(), H5P_DEFAULT, piece.data()) < 0)
        refuse(path, "cannot be read");
    }
  }

  std::uint64_t file_bytes_, unclaimed_;
  Hdf5Storage storage_;
  std::set<haddr_t> seen_;
};

constexpr unsigned kReadAttempts = 5;  // of what is damaged, instead of a hundred with pauses

std::string fault_of_file(const std::string& path, unsigned mode, const Hdf5Handle& access,
                          Walk walk) {
  const Hdf5Handle file(H5Fopen(path.c_str(), mode, access.get()), H5Fclose);
  if (!file) return "it cannot be opened as an HDF5 file (" + hdf5_cause() + ")";
  const Hdf5Handle root(H5Oopen(file.get(), "/", H5P_DEFAULT), H5Oclose);
  if (!root) return "/ cannot be opened";
  try {
    walk.object(root.get(), "/", 0);
  } catch (const Fault& fault) {
    return fault.text;
  }
  return "";
}

}  // namespace

std::string hdf5_structure_fault(const std::string& path, Hdf5Storage storage) {
  silence_hdf5();
  std::error_code unknown;
  const std::uint64_t bytes = std::filesystem::file_size(path, unknown);
  check_io(unknown.value(), path, "cannot be read");
  const unsigned mode =
      storage == Hdf5Storage::growing ? H5F_ACC_RDONLY | H5F_ACC_SWMR_READ : H5F_ACC_RDONLY;
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access.get(), true, true);
  if (storage == Hdf5Storage::growing) H5Pset_metadata_read_attempts(access.get(), kReadAttempts);
  Hdf5Io io;
  use_driver(access.get(), io);
  const std::string fault = fault_of_file(path, mode, access, Walk(bytes, storage));
  check_io(io.error(), path, "cannot be read");
  return fault;
}

}  // namespace bem
