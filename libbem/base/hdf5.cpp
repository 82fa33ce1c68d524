#include "base/hdf5.hpp"

#include "base/hdf5_handle.hpp"

#include <filesystem>

namespace bem {
namespace {

static_assert(std::is_same_v<hid_t, std::int64_t>, "the header spells hid_t without hdf5.h");

[[noreturn]] void fail_at_file(const std::string& path, ErrorCode error, const std::string& what) {
  const std::string cause = hdf5_cause();
  throw Error(error, path + ": " + what + (cause.empty() ? "" : " (" + cause + ")"));
}

Hdf5Handle file_access() {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Some network file systems have no locks: go on without them.
  require(H5Pset_file_locking(access.get(), true, true) >= 0, "HDF5 file locking");
  return access;
}

/// Access for a new file. The format version is fixed, so that the bytes do not depend on what a
/// later library thinks best: 1.8's is read by everything; SWMR needs 1.10's.
Hdf5Handle new_file_access(bool swmr) {
  Hdf5Handle access = file_access();
  const H5F_libver_t version = swmr ? H5F_LIBVER_V110 : H5F_LIBVER_V18;
  require(H5Pset_libver_bounds(access.get(), version, version) >= 0, "HDF5 format version");
  // A flush gives back what is reserved for small objects to come: without such reserves the bytes
  // of a file that grows do not depend on when it is flushed.
  if (swmr)
    require(H5Pset_meta_block_size(access.get(), 0) >= 0 &&
                H5Pset_small_data_block_size(access.get(), 0) >= 0,
            "HDF5 files without reserves");
  return access;
}

/// The groups above: "/a" and "/a/b" for "/a/b/c".
std::vector<std::string> parents(const std::string& path) {
  std::vector<std::string> result;
  for (std::size_t i = path.find('/', 1); i != std::string::npos; i = path.find('/', i + 1))
    result.push_back(path.substr(0, i));
  return result;
}

}  // namespace

Hdf5File Hdf5File::create(const std::string& path, const Hdf5CreateOptions& options) {
  silence_hdf5();
  const Hdf5Handle access = new_file_access(options.swmr);
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  require(H5Pset_userblock(creation.get(), options.user_block) >= 0, "size of an HDF5 user block");
  require(H5Pset_obj_track_times(creation.get(), false) >= 0, "HDF5 files without time stamps");
  const Id id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get());
  if (id < 0) fail_at_file(path, options.error, "cannot be created");
  return Hdf5File(path, options.error, id);
}

Hdf5File Hdf5File::open(const std::string& path, ErrorCode error) {
  return open(path, error, H5F_ACC_RDONLY);
}

Hdf5File Hdf5File::open_growing(const std::string& path, ErrorCode error) {
  return open(path, error, H5F_ACC_RDONLY | H5F_ACC_SWMR_READ);
}

Hdf5File Hdf5File::open(const std::string& path, ErrorCode error, unsigned mode) {
  silence_hdf5();
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) throw Error(error, path + ": no such file");
  if (std::filesystem::is_directory(status))
    throw Error(error, path + ": is a directory, not an HDF5 file");
  const htri_t recognised = H5Fis_hdf5(path.c_str());
  if (recognised == 0) throw Error(error, path + ": is not an HDF5 file");
  if (recognised < 0) fail_at_file(path, error, "cannot be opened");
  const Hdf5Handle access = file_access();
  const Id id = H5Fopen(path.c_str(), mode, access.get());
  if (id < 0) fail_at_file(path, error, "cannot be opened as an HDF5 file");
  return Hdf5File(path, error, id);
}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : path_(std::move(other.path_)), error_(other.error_), id_(std::exchange(other.id_, -1)) {}

Hdf5File& Hdf5File::operator=(Hdf5File&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(error_, other.error_);
  std::swap(id_, other.id_);
  return *this;
}

Hdf5File::~Hdf5File() {
  if (id_ < 0) return;
  silence_hdf5();
  H5Fclose(id_);
}

Hdf5File::Id Hdf5File::id() const {
  require(id_ >= 0, "an HDF5 file is used after it was closed");
  silence_hdf5();
  return id_;
}

void Hdf5File::fail(const std::string& object, const std::string& cause) const {
  throw Error(error_, path_ + ": " + object + ": " + cause);
}

void Hdf5File::fail_in_library(const std::string& object, const std::string& action) const {
  fail_at_file(path_, error_, object + ": " + action);
}

void Hdf5File::flush() {
  if (H5Fflush(id(), H5F_SCOPE_GLOBAL) < 0) fail_at_file(path_, error_, "cannot be written");
}

void Hdf5File::close() {
  flush();
  if (H5Fclose(std::exchange(id_, -1)) < 0) fail_at_file(path_, error_, "cannot be closed");
}

void Hdf5File::start_swmr() {
  if (H5Fstart_swmr_write(id()) < 0)
    fail_at_file(path_, error_, "cannot be shared with readers while it is written");
}

bool Hdf5File::exists(const std::string& path) const {
  const Id file = id();
  if (path == "/") return true;
  for (const std::string& parent : parents(path))
    if (H5Lexists(file, parent.c_str(), H5P_DEFAULT) <= 0) return false;
  return H5Lexists(file, path.c_str(), H5P_DEFAULT) > 0 &&
         H5Oexists_by_name(file, path.c_str(), H5P_DEFAULT) > 0;
}

bool Hdf5File::is_group(const std::string& path) const {
  if (!exists(path)) return false;
  const Hdf5Handle object(H5Oopen(id(), path.c_str(), H5P_DEFAULT), H5Oclose);
  return object && H5Iget_type(object.get()) == H5I_GROUP;
}

std::vector<std::string> Hdf5File::children(const std::string& group) const {
  if (!is_group(group)) fail(group, "no such group");
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->push_back(name);
    return 0;
  };
  if (H5Literate_by_name(id(), group.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names,
                         H5P_DEFAULT) < 0)
    fail_in_library(group, "cannot be listed");
  return names;
}

void Hdf5File::create_group(const std::string& path) {
  std::vector<std::string> chain = parents(path);
  chain.push_back(path);
  for (const std::string& group : chain) {
    if (is_group(group)) continue;
    // One by one: groups that the library makes along the way carry the time of their creation.
    const Hdf5Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation.get(), false);
    const Hdf5Handle made(H5Gcreate2(id(), group.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
                          H5Gclose);
    if (!made) fail_in_library(group, "the group cannot be created");
  }
}

}  // namespace bem
