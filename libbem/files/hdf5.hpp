#pragma once

#include "base/error.hpp"
#include "files/hdf5_types.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace bem {

class Hdf5Io;

/// An HDF5 file and everything in it, by path: "/a/b", where "/" is the file's root group.
///
/// Files are bit-identical when the same calls with the same data are made again: no time stamps,
/// fixed format version, storage in the order of creation. Text is UTF-8.
///
/// Every failure throws Error with the file's code (ErrorCode::resources if the system failed) and
/// a message that names file and object; the HDF5 library itself prints nothing. No failed write is
/// forgotten: when flush() or close() return, everything is in the file. Calls that cannot be right
/// whatever the file holds (a closed file, no extents) throw ErrorCode::internal. Not thread safe,
/// not even for two different files.
class Hdf5File {
 public:
  /// Creates the file, overwriting an existing one, through no link. The user block is zeros.
  static Hdf5File create(const std::string& path, const Hdf5CreateOptions& options = {});
  /// Opens read-only. The library can crash on a damaged file: check a digest before, if any.
  static Hdf5File open(const std::string& path, ErrorCode error);
  /// The same of a file that is written in SWMR mode, or was when its writer was killed.
  static Hdf5File open_growing(const std::string& path, ErrorCode error);

  Hdf5File(Hdf5File&& other) noexcept;
  Hdf5File& operator=(Hdf5File&& other) noexcept;
  ~Hdf5File();  ///< closes without a check: call close() to learn of errors

  const std::string& path() const { return path_; }
  ErrorCode error() const { return error_; }  ///< of everything that fails with the file
  void flush();  ///< hands everything written so far to the operating system
  void sync();   ///< flushes, and waits until it is on the disk
  void close();  ///< flushes and closes; nothing but destruction may follow
  /// Lets other processes read while this one goes on writing (single writer, multiple readers);
  /// no object can be created from here on.
  void start_swmr();

  bool exists(const std::string& path) const;
  bool is_group(const std::string& path) const;
  std::vector<std::string> children(const std::string& group) const;  ///< names in byte order
  Hdf5Dims dims(const std::string& path) const;
  Hdf5Type type(const std::string& path) const;
  /// Checks that there is a dataset of this type and these extents.
  void require_dataset(const std::string& path, Hdf5Type type, const Hdf5Dims& dims) const;
  /// Bytes that a dataset takes in the file.
  std::uint64_t stored_bytes(const std::string& path) const;

  /// Creates a group, which may exist, and those above it. The functions that create datasets also
  /// create the groups above them.
  void create_group(const std::string& path);
  void create_dataset(const std::string& path, Hdf5Type type, const Hdf5Dims& dims,
                      const Hdf5Layout& layout = {});
  void extend_rows(const std::string& path, std::size_t rows);  ///< sets dims[0]; new rows are 0

  /// Creates a dataset and fills it.
  template <class T>
  void write(const std::string& path, const T* data, const Hdf5Dims& dims) {
    create_dataset(path, hdf5_type<T>(), dims);
    write_block(path, Hdf5Dims(dims.size(), 0), dims, data);
  }
  template <class T>
  void write(const std::string& path, const std::vector<T>& data, const Hdf5Dims& dims) {
    check_size(path, data.size(), dims);
    write(path, data.data(), dims);
  }

  /// Writes the part of an existing dataset that begins at `start` with extents `count`; `data` is
  /// row-major and dense. Types are converted as in read_block.
  template <class T>
  void write_block(const std::string& path, const Hdf5Dims& start, const Hdf5Dims& count,
                   const T* data) {
    write_raw(path, hdf5_type<T>(), start, count, data);
  }
  template <class T>
  void write_rows(const std::string& path, std::size_t first, std::size_t rows, const T* data) {
    const Part part = part_of_rows(path, first, rows);
    write_raw(path, hdf5_type<T>(), part.start, part.count, data);
  }

  /// Reads the part that begins at `start` with extents `count` to `out`, row-major and dense.
  /// Converts between float64 and float32 and from integers to either; an integer is read only into
  /// a type that holds all values of the stored one.
  template <class T>
  void read_block(const std::string& path, const Hdf5Dims& start, const Hdf5Dims& count,
                  T* out) const {
    read_raw(path, hdf5_type<T>(), start, count, out);
  }
  template <class T>
  void read_rows(const std::string& path, std::size_t first, std::size_t rows, T* out) const {
    const Part part = part_of_rows(path, first, rows);
    read_raw(path, hdf5_type<T>(), part.start, part.count, out);
  }

  /// Reads a whole dataset, which must have the extents `expected`.
  template <class T>
  std::vector<T> read(const std::string& path, const Hdf5Dims& expected) const {
    std::vector<T> data(checked_count(path, expected, sizeof(T)));
    read_raw(path, hdf5_type<T>(), Hdf5Dims(expected.size(), 0), expected, data.data());
    return data;
  }
  template <class T>
  std::vector<T> read(const std::string& path) const {
    return read<T>(path, dims(path));
  }

  /// Attributes of groups and datasets; setting one again replaces it.
  void set_attribute(const std::string& object, const std::string& name, const std::string& value);
  void set_attribute(const std::string& object, const std::string& name, const char* text);
  void set_attribute(const std::string& object, const std::string& name, double value);
  void set_attribute(const std::string& object, const std::string& name, std::int64_t value);
  template <class Integer, class = std::enable_if_t<std::is_integral_v<Integer>>>
  void set_attribute(const std::string& object, const std::string& name, Integer value) {
    set_attribute(object, name, static_cast<std::int64_t>(value));
  }
  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string string_attribute(const std::string& object, const std::string& name) const;
  double double_attribute(const std::string& object, const std::string& name) const;
  std::int64_t int_attribute(const std::string& object, const std::string& name) const;

 private:
  friend class Hdf5Rows;
  using Id = std::int64_t;  // hid_t

  Hdf5File(std::string path, ErrorCode error, Id id, std::unique_ptr<Hdf5Io> io);
  static Hdf5File open(const std::string& path, ErrorCode error, unsigned mode);
  Id id() const;
  void check_written() const;
  bool close_library();
  [[noreturn]] void fail(const std::string& object, const std::string& cause) const;
  [[noreturn]] void fail_in_library(const std::string& object, const std::string& action) const;
  void check_size(const std::string& path, std::size_t size, const Hdf5Dims& dims) const;
  std::size_t checked_count(const std::string& path, const Hdf5Dims& expected,
                            std::size_t bytes) const;
  void check_part(const std::string& path, const Hdf5Dims& start, const Hdf5Dims& count) const;
  struct Part {
    Hdf5Dims start, count;
  };
  Part part_of_rows(const std::string& path, std::size_t first, std::size_t rows) const;
  void write_raw(const std::string& path, Hdf5Type type, const Hdf5Dims& start,
                 const Hdf5Dims& count, const void* data);
  void read_raw(const std::string& path, Hdf5Type type, const Hdf5Dims& start,
                const Hdf5Dims& count, void* out) const;

  std::string path_;
  ErrorCode error_;
  Id id_;
  std::unique_ptr<Hdf5Io> io_;
};

}  // namespace bem
