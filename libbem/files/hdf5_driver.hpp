#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <hdf5.h>

namespace bem {

/// What the file driver below knows of a file. HDF5 cannot deal with failed writes: it forgets
/// some, and crashes when it closes a file after others. So after the first failure the driver
/// remembers it, leaves the file alone, and lets HDF5 believe that all is well until it is closed;
/// whoever owns the file asks error() before he counts on what was written.
class Hdf5Io {
 public:
  /// `undo`: after a failure the file is again what it was at the last mark().
  explicit Hdf5Io(bool undo = false) : undo_(undo) {}
  Hdf5Io(const Hdf5Io&) = delete;
  Hdf5Io& operator=(const Hdf5Io&) = delete;

  int error() const { return error_; }  ///< of the first failed call of the system; 0 is none
  /// What has been written until here stays whatever comes.
  void mark();
  int sync();  ///< 0, or why the data cannot be brought to the disk
  /// Is this the path of the file?
  bool is_at(const std::string& path) const;

 private:
  friend struct Hdf5Driver;
  void fail(int error);
  bool save(std::uint64_t position, std::uint64_t size);
  void write(std::uint64_t position, std::uint64_t size, const void* data);

  bool undo_;
  int error_ = 0, file_ = -1;
  std::uint64_t device_ = 0, inode_ = 0;
  std::uint64_t size_ = 0;  ///< as HDF5 believes
  std::uint64_t marked_size_ = 0;
  std::vector<std::pair<std::uint64_t, std::string>> overwritten_;  ///< since the mark, by position
};

/// Makes files that are opened with these properties use the driver: HDF5's own for POSIX files but
/// for what is said above, and that it follows no link when it creates a file. The bytes and the
/// locks are the same. `io` must live until the file is closed, and serves one file at a time.
void use_driver(hid_t file_access, Hdf5Io& io);

}  // namespace bem
