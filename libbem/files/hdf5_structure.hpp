#pragma once

#include "base/error.hpp"

#include <string>

namespace bem {

/// How the datasets of an HDF5 file are stored.
enum class Hdf5Storage {
  whole,   ///< in one piece each, as archives have them
  growing  ///< or in chunks, as trajectories have them
};

/// What is wrong with the structure of an HDF5 file; empty if nothing is. It must be made as this
/// project makes files, whatever it holds: a tree of groups and datasets by hard links, every
/// object once; datasets of one of the types of Hdf5Type with extents, in this file itself (no
/// external files, no virtual datasets), unfiltered; all numbers that the extents promise are
/// there, so that no file makes its reader allocate more than a few times its own size; attributes
/// that are one text, integer or number.
///
/// The library may crash or go on for ever on a file that is bad enough: to be called in a process
/// of its own (files/file_check.hpp). Of growing datasets all chunks are read, of others nothing.
/// Throws ErrorCode::resources if the system refuses to open or to read the file.
std::string hdf5_structure_fault(const std::string& path, Hdf5Storage storage);

}  // namespace bem
