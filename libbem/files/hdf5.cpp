#include "files/hdf5.hpp"

#include "files/file_io.hpp"
#include "files/hdf5_driver.hpp"
#include "files/hdf5_handle.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>

#include <fcntl.h>

namespace bem {
namespace {

static_assert(std::is_same_v<hid_t, std::int64_t>, "the header spells hid_t without hdf5.h");

/// Of the system, if it failed, or else of the library.
[[noreturn]] void fail_at_file(const std::string& path, ErrorCode error, const std::string& what,
                               const Hdf5Io& io) {
  const std::string cause = io.error() != 0 ? std::strerror(io.error()) : hdf5_cause();
  throw Error(io.error() != 0 ? ErrorCode::resources : error,
              path + ": " + what + (cause.empty() ? "" : " (" + cause + ")"));
}

Hdf5Handle file_access(Hdf5Io& io, bool locking) {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  require(H5Pset_file_locking(access.get(), locking, true) >= 0, "HDF5 file locking");
  use_driver(access.get(), io);
  return access;
}

/// Access for a new file. The format version is fixed, so that the bytes do not depend on what a
/// later library thinks best: 1.8's is read by everything; SWMR needs 1.10's. Nobody else opens it
/// before it is complete or grows in SWMR mode, so it needs no lock.
Hdf5Handle new_file_access(Hdf5Io& io, bool swmr) {
  Hdf5Handle access = file_access(io, false);
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

/// Does the file have HDF5's signature, at its begin or after a user block? The library's own
/// question cannot tell a failure of the system from a foreign file.
bool has_signature(const std::string& path) {
  constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";
  constexpr std::uint64_t kSmallestBlock = 512;
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  check_io(file ? 0 : errno, path, "cannot be opened");
  for (std::uint64_t at = 0;; at = std::max(kSmallestBlock, 2 * at)) {
    std::string bytes(kSignature.size(), '\0');
    std::size_t got = 0;
    check_io(read_fully(file.get(), bytes.data(), bytes.size(), at, got), path, "cannot be read");
    if (bytes == kSignature) return true;
    if (got < bytes.size()) return false;
  }
}

/// Takes the mark of a growing file off one that was given up, as HDF5's h5clear does.
void clear_growing_mark(const std::string& path) {
  Hdf5Io io;
  const Hdf5Handle access = file_access(io, false);
  const hbool_t clear = true;
  H5Pset(access.get(), "clear_status_flags", &clear);
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.get()), H5Fclose);
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
  auto io = std::make_unique<Hdf5Io>(options.swmr);
  const std::string& name = options.name.empty() ? path : options.name;
  const Hdf5Handle access = new_file_access(*io, options.swmr);
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  require(H5Pset_userblock(creation.get(), options.user_block) >= 0, "size of an HDF5 user block");
  require(H5Pset_obj_track_times(creation.get(), false) >= 0, "HDF5 files without time stamps");
  const Id id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get());
  if (id < 0) fail_at_file(name, options.error, "cannot be created", *io);
  return Hdf5File(name, options.error, id, std::move(io));
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
  auto io = std::make_unique<Hdf5Io>();
  if (!has_signature(path)) throw Error(error, path + ": is not an HDF5 file");
  const Hdf5Handle access = file_access(*io, true);
  const Id id = H5Fopen(path.c_str(), mode, access.get());
  if (id < 0) fail_at_file(path, error, "cannot be opened as an HDF5 file", *io);
  return Hdf5File(path, error, id, std::move(io));
}

Hdf5File::Hdf5File(std::string path, ErrorCode error, Id id, std::unique_ptr<Hdf5Io> io)
    : path_(std::move(path)), error_(error), id_(id), io_(std::move(io)) {}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : path_(std::move(other.path_)),
      error_(other.error_),
      id_(std::exchange(other.id_, -1)),
      io_(std::move(other.io_)) {}

Hdf5File& Hdf5File::operator=(Hdf5File&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(error_, other.error_);
  std::swap(id_, other.id_);
  std::swap(io_, other.io_);
  return *this;
}

Hdf5File::~Hdf5File() {
  if (id_ < 0) return;
  silence_hdf5();
  close_library();
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
  fail_at_file(path_, error_, object + ": " + action, *io_);
}

void Hdf5File::check_written() const {
  if (io_->error() != 0) fail_at_file(path_, error_, "cannot be written", *io_);
}

void Hdf5File::flush() {
  if (H5Fflush(id(), H5F_SCOPE_GLOBAL) < 0) fail_at_file(path_, error_, "cannot be written", *io_);
  check_written();
  io_->mark();
}

void Hdf5File::sync() {
  flush();
  if (io_->sync() != 0) check_written();
}

bool Hdf5File::close_library() {
  const bool closed = H5Fclose(std::exchange(id_, -1)) >= 0;
  if (!closed)
    static_cast<void>(io_.release());  // the library may still have it
  else if (io_->error() != 0 && io_->is_at(path_))
    clear_growing_mark(path_);
  return closed;
}

void Hdf5File::close() {
  flush();
  if (!close_library()) throw Error(error_, path_ + ": cannot be closed");
  check_written();
}

void Hdf5File::start_swmr() {
  if (H5Fstart_swmr_write(id()) < 0)
    fail_at_file(path_, error_, "cannot be shared with readers while it is written", *io_);
  check_written();
  io_->mark();
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
