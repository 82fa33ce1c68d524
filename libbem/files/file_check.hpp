#pragma once

#include "files/hdf5_structure.hpp"

namespace bem {

/// Checks the structure of an HDF5 file in a process of its own, before this one opens it
/// (files/hdf5_structure.hpp): no file makes the library crash here, go on for ever, or read other
/// files. Throws Error with `code` and a message that names the file and the place in it, or
/// ErrorCode::resources if no process can be started. About 30 ms, most of them for the process; of
/// growing files also the time to read them once.
void check_hdf5_file(const std::string& path, Hdf5Storage storage, ErrorCode code);

}  // namespace bem
