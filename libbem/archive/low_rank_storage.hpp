#pragma once

#include "compress/low_rank_family.hpp"
#include "files/hdf5.hpp"

#include <functional>

namespace bem {

/// Attribute of the group of a symmetric family.
inline constexpr const char* kSymmetricAttribute = "symmetric";

/// A LowRankFamily in a group of an HDF5 file (docs/archive-format.md). `report` gets the bytes of
/// large data that have been read or written.
using BytesReport = std::function<void(std::size_t)>;
void write_low_rank(Hdf5File& file, const std::string& group, const LowRankFamily& family,
                    const BytesReport& report);

/// With `columns` (ascending) only the blocks that meet them are read. Throws ErrorCode::archive if
/// the group does not describe a family of `count` matrices of `size` unknowns.
std::unique_ptr<LowRankFamily> read_low_rank(const Hdf5File& file, const std::string& group,
                                             std::size_t size, int count,
                                             const std::vector<int>* columns,
                                             const BytesReport& report);

}  // namespace bem
