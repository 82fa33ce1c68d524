#include "files/hdf5_driver.hpp"

#include "base/error.hpp"
#include "files/file_io.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <new>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

namespace bem {

void Hdf5Io::mark() {
  if (error_ != 0) return;
  marked_size_ = size_;
  overwritten_.clear();
}

int Hdf5Io::sync() {
  if (error_ == 0 && file_ >= 0) error_ = sync_file(file_);
  return error_;
}

bool Hdf5Io::is_at(const std::string& path) const {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 && status.st_dev == device_ && status.st_ino == inode_;
}

/// A file that cannot be restored either is like one whose writer was killed.
void Hdf5Io::fail(int error) {
  error_ = error;
  if (!undo_) return;
  bool restored = true;
  for (auto it = overwritten_.rbegin(); it != overwritten_.rend(); ++it)
    restored = write_fully(file_, it->second.data(), it->second.size(), it->first) == 0 && restored;
  if (restored) cut_file(file_, marked_size_);
}

/// Takes note of what is about to be overwritten.
bool Hdf5Io::save(std::uint64_t position, std::uint64_t size) {
  if (!undo_ || position >= marked_size_) return true;
  std::string bytes(std::min(size, marked_size_ - position), '\0');
  std::size_t got = 0;
  if (const int error = read_fully(file_, bytes.data(), bytes.size(), position, got)) {
    fail(error);
    return false;
  }
  overwritten_.emplace_back(position, std::move(bytes));
  return true;
}

void Hdf5Io::write(std::uint64_t position, std::uint64_t size, const void* data) {
  size_ = std::max(size_, position + size);
  if (error_ != 0 || !save(position, size)) return;
  if (const int error = write_fully(file_, data, size, position)) fail(error);
}

/// The functions that HDF5 calls.
struct Hdf5Driver {
  H5FD_t base;  // first: HDF5 has pointers to it
  Hdf5Io* io;
  haddr_t end;  ///< of what HDF5 has allocated

  static Hdf5Driver& of(H5FD_t* file) { return *reinterpret_cast<Hdf5Driver*>(file); }
  static const Hdf5Driver& of(const H5FD_t* file) {
    return *reinterpret_cast<const Hdf5Driver*>(file);
  }

  static H5FD_t* open(const char* path, unsigned flags, hid_t access, haddr_t) {
    auto& io = **static_cast<Hdf5Io* const*>(H5Pget_driver_info(access));
    int mode = O_CLOEXEC | ((flags & H5F_ACC_RDWR) != 0 ? O_RDWR : O_RDONLY);
    if ((flags & H5F_ACC_TRUNC) != 0) mode |= O_TRUNC;
    if ((flags & H5F_ACC_CREAT) != 0) mode |= O_CREAT | O_NOFOLLOW;
    if ((flags & H5F_ACC_EXCL) != 0) mode |= O_EXCL;
    FileDescriptor file(::open(path, mode, 0666));
    struct stat status {};
    io.error_ = file && ::fstat(file.get(), &status) == 0 ? 0 : errno;
    if (io.error_ != 0) return nullptr;
    auto* driver = new (std::nothrow) Hdf5Driver{};
    if (!driver) return nullptr;
    driver->io = &io;
    io.file_ = file.release();
    io.device_ = status.st_dev;
    io.inode_ = status.st_ino;
    io.size_ = static_cast<std::uint64_t>(status.st_size);
    io.marked_size_ = 0;
    return &driver->base;
  }

  static herr_t close(H5FD_t* file) {
    Hdf5Driver& driver = of(file);
    FileDescriptor open(std::exchange(driver.io->file_, -1));
    const int error = close_file(open);
    if (driver.io->error_ == 0) driver.io->error_ = error;
    delete &driver;
    return 0;
  }

  /// Files that are open twice are two to HDF5: it would use the driver of the first one for both,
  /// even after the first is closed and its Hdf5Io is gone.
  static int compare(const H5FD_t* a, const H5FD_t* b) {
    const std::less<const H5FD_t*> before;
    return before(a, b) ? -1 : before(b, a) ? 1 : 0;
  }

  static herr_t query(const H5FD_t*, unsigned long* flags) {
    if (flags)
      *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
               H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_POSIX_COMPAT_HANDLE |
               H5FD_FEAT_SUPPORTS_SWMR_IO | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
  }

  static haddr_t get_end(const H5FD_t* file, H5FD_mem_t) { return of(file).end; }
  static herr_t set_end(H5FD_t* file, H5FD_mem_t, haddr_t end) {
    of(file).end = end;
    return 0;
  }
  static haddr_t size(const H5FD_t* file, H5FD_mem_t) { return of(file).io->size_; }
  static herr_t handle(H5FD_t* file, hid_t, void** out) {
    *out = &of(file).io->file_;
    return 0;
  }

  static herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t position, std::size_t bytes,
                     void* out) {
    Hdf5Io& io = *of(file).io;
    std::size_t got = 0;
    const int error = read_fully(io.file_, out, bytes, position, got);
    if (io.error_ == 0) io.error_ = error;
    std::memset(static_cast<char*>(out) + got, 0, bytes - got);  // as HDF5 expects beyond the end
    return error == 0 ? 0 : -1;
  }

  static herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t position, std::size_t bytes,
                      const void* data) {
    try {
      of(file).io->write(position, bytes, data);
    } catch (const std::bad_alloc&) {
      of(file).io->fail(ENOMEM);
    }
    return 0;
  }

  static herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
    Hdf5Driver& driver = of(file);
    Hdf5Io& io = *driver.io;
    if (io.size_ == driver.end) return 0;
    io.size_ = driver.end;
    if (io.error_ != 0) return 0;
    if (const int error = cut_file(io.file_, driver.end)) io.fail(error);
    return 0;
  }

  static herr_t lock(H5FD_t* file, hbool_t exclusive) {
    return set_lock(file, (exclusive ? LOCK_EX : LOCK_SH) | LOCK_NB);
  }
  static herr_t unlock(H5FD_t* file) { return set_lock(file, LOCK_UN); }
  static herr_t set_lock(H5FD_t* file, int kind) {
    // Some network file systems have no locks: go on without them.
    return ::flock(of(file).io->file_, kind) == 0 || errno != EWOULDBLOCK ? 0 : -1;
  }
};

void use_driver(hid_t file_access, Hdf5Io& io) {
  static const hid_t driver = [] {
    H5FD_class_t c{};
    c.name = "bem";
    c.maxaddr = (haddr_t(1) << 63) - 1;
    c.fc_degree = H5F_CLOSE_WEAK;
    c.fapl_size = sizeof(Hdf5Io*);
    c.open = Hdf5Driver::open;
    c.close = Hdf5Driver::close;
    c.cmp = Hdf5Driver::compare;
    c.query = Hdf5Driver::query;
    c.get_eoa = Hdf5Driver::get_end;
    c.set_eoa = Hdf5Driver::set_end;
    c.get_eof = Hdf5Driver::size;
    c.get_handle = Hdf5Driver::handle;
    c.read = Hdf5Driver::read;
    c.write = Hdf5Driver::write;
    c.truncate = Hdf5Driver::truncate;
    c.lock = Hdf5Driver::lock;
    c.unlock = Hdf5Driver::unlock;
    const H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;
    std::copy(std::begin(map), std::end(map), c.fl_map);
    return H5FDregister(&c);
  }();
  Hdf5Io* const info = &io;
  if (driver < 0 || H5Pset_driver(file_access, driver, &info) < 0)
    throw Error(ErrorCode::resources, "the HDF5 library cannot be set up");
}

}  // namespace bem
