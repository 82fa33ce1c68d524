#pragma once

#include "files/hdf5.hpp"

#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace bem {

/// Where a family is in an archive: a compressed one in `group`; of an uncompressed one matrix k in
/// the dataset paths[k].
struct FamilyPlace {
  std::string group;
  std::vector<std::string> paths;

  int count() const { return static_cast<int>(paths.size()); }
};

/// Gets the bytes of large data that have been read or written since the last call; may throw to
/// stop.
using BytesReport = std::function<void(std::size_t)>;

/// Bytes of large data that are read or written at a time.
inline constexpr std::size_t kPieceBytes = std::size_t(32) << 20;

/// A dataset in the group of a compressed family: one-dimensional, or a table with some columns.
struct FamilyDataset {
  const char* name;  ///< with a slash in front
  Hdf5Type type;
  std::size_t columns = 0;  ///< 0: one-dimensional
};

/// Checks that the group of a compressed family has these datasets and holds as many matrices as
/// its place says. Throws ErrorCode::archive.
void check_family_group(const Hdf5File& file, const FamilyPlace& place,
                        std::initializer_list<FamilyDataset> datasets);

/// Bytes of some one-dimensional datasets of a group, which have a byte an entry.
std::size_t bytes_in_group(const Hdf5File& file, const FamilyPlace& place,
                           std::initializer_list<const char*> names);

}  // namespace bem
