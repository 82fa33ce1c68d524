#pragma once

#include "files/hdf5.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bem {

/// A dataset of numbers that grows by rows and stays open (an integer type takes what is whole):
/// what is asked of the library for one more row does not depend on how many other datasets there
/// are. To be destroyed before its file is closed; errors are those of the file.
class Hdf5Rows {
 public:
  /// Opens a dataset of the file that was created extendible. Its rows so far stay.
  Hdf5Rows(Hdf5File& file, std::string path);
  Hdf5Rows(Hdf5Rows&& other) noexcept;
  Hdf5Rows& operator=(Hdf5Rows&& other) noexcept;
  ~Hdf5Rows();

  /// Adds rows, dense and row-major.
  void append(std::size_t rows, const double* values);

 private:
  [[noreturn]] void fail(const char* action) const;

  std::string file_, path_;
  ErrorCode error_;
  std::int64_t id_ = -1;             ///< hid_t
  std::vector<std::uint64_t> dims_;  ///< hsize_t
};

}  // namespace bem
