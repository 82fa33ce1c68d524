#pragma once

#include "archive/archive_reader.hpp"

#include <iosfwd>

namespace bem {

/// Prints what differs between two archives, with the relative error |A - B| / |A| of every
/// matrix (Frobenius norm), or "identical". Streams the matrices. Returns whether they are equal.
bool print_differences(std::ostream& out, const Archive& a, const Archive& b,
                       const Progress& progress);

}  // namespace bem
