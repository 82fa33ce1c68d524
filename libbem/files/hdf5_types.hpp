#pragma once

#include "base/error.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace bem {

/// Number types of datasets; stored little-endian on every machine.
enum class Hdf5Type { float64, float32, int32, int64, uint64, uint8 };

/// Extents of a dataset (row-major) or of a part of one.
using Hdf5Dims = std::vector<std::size_t>;

/// The Hdf5Type of a C++ type.
template <class T>
constexpr Hdf5Type hdf5_type() {
  if constexpr (std::is_same_v<T, double>) {
    return Hdf5Type::float64;
  } else if constexpr (std::is_same_v<T, float>) {
    return Hdf5Type::float32;
  } else if constexpr (std::is_same_v<T, std::int32_t>) {
    return Hdf5Type::int32;
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    return Hdf5Type::int64;
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    return Hdf5Type::uint64;
  } else {
    static_assert(std::is_same_v<T, std::uint8_t>, "no Hdf5Type for this type");
    return Hdf5Type::uint8;
  }
}

struct Hdf5CreateOptions {
  std::string name = {};                   ///< what messages call the file, if not by its path
  ErrorCode error = ErrorCode::resources;  ///< code of everything that fails with the file
  std::size_t user_block = 0;  ///< bytes in front that HDF5 leaves alone: 0 or a power of 2 >= 512
  /// start_swmr() will be called (needs the newer 1.10 format). A failed write then takes the file
  /// back to what it was after the last flush().
  bool swmr = false;
};

struct Hdf5Layout {
  Hdf5Dims chunk;           ///< extents of one chunk; empty is contiguous storage
  bool extendible = false;  ///< extend_rows() may be called; needs a chunk
};

}  // namespace bem
