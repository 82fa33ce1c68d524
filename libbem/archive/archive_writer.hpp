#pragma once

#include "archive/provenance.hpp"
#include "model/precompute.hpp"

#include <string>

namespace bem {

/// Checks whether an archive can be written to `path`, before the matrices are computed. Throws
/// ErrorCode::usage if the file exists and `force` is not set, ErrorCode::resources if the folder
/// cannot be written or has less than `bytes` of free space.
void check_archive_target(const std::string& path, bool force, double bytes = 0);

/// Size of the file [bytes] when the large matrices take `stored` (model/memory_estimate.hpp).
double archive_bytes(const BodyGeometry& geometry, const PrecomputeOptions& options, double stored);

/// Writes an archive (docs/archive-format.md): under a temporary name beside `path`, which gets its
/// own name when everything is on the disk. Whatever fails or is thrown by `progress` leaves
/// neither of the two behind, and a file that has the name already as it was; without `force` so
/// does one that has come in the meantime. The bytes depend on the arguments alone. All matrices of
/// the model must be in memory, uncompressed. Throws as check_archive_target.
void write_archive(const std::string& path, const BodyModel& model, const Provenance& provenance,
                   bool force, const Progress& progress = nullptr);

}  // namespace bem
