#pragma once

#include "compress/family_storage.hpp"
#include "compress/haar_family.hpp"

namespace bem {

/// A HaarFamily in a group of an HDF5 file (docs/archive-format.md).
void write_haar(Hdf5File& file, const std::string& group, const HaarFamily& family,
                const BytesReport& report);

/// With `columns` (ascending) only the coefficients that meet them are kept. Throws
/// ErrorCode::archive if the group does not describe a family of `count` matrices of `size`
/// unknowns.
std::unique_ptr<HaarFamily> read_haar(const Hdf5File& file, const std::string& group,
                                      std::size_t size, int count, const std::vector<int>* columns,
                                      const BytesReport& report);

}  // namespace bem
