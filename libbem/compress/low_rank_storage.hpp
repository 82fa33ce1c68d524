#pragma once

#include "compress/family_storage.hpp"
#include "compress/low_rank_family.hpp"

namespace bem {

/// A LowRankFamily in a group of an HDF5 file (docs/archive-format.md).
void write_low_rank(Hdf5File& file, const std::string& group, const LowRankFamily& family,
                    const BytesReport& report);

/// With `columns` (ascending) only the blocks that meet them are read. Throws ErrorCode::archive if
/// the group does not describe a family of `count` matrices of `size` unknowns.
std::unique_ptr<LowRankFamily> read_low_rank(const Hdf5File& file, const std::string& group,
                                             std::size_t size, int count,
                                             const std::vector<int>* columns,
                                             const BytesReport& report);

/// LowRankFamily::coefficients() of the family in a group.
std::size_t low_rank_coefficients(const Hdf5File& file, const std::string& group);

}  // namespace bem
