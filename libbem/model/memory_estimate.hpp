#pragma once

#include "model/precompute.hpp"

namespace bem {

/// Bytes of the matrices that precompute() will store.
struct StoredEstimate {
  double bytes = 0;
  double assembly_bytes = 0;    ///< of compressed ones: of what exists at the end of the assembly
  double assembly_seconds = 0;  ///< of compressed ones: of all of them on this machine
};
/// Exact for codec "none"; for "lowrank" from a few slabs, which are assembled and compressed for
/// it; for "haar" from its ratio, and with a tolerance what they take uncompressed.
StoredEstimate estimate_stored(const BodyGeometry& geometry, const PrecomputeOptions& options);

/// Bytes of the largest working set of precompute().
///
/// Codec "none": the matrices of all lags, and of lag 0 the complex ones that are factorised.
/// Compressed: what is stored at the end of the assembly; H_0 of all components, 8 or 16 (3N)^2
/// bytes, unless the inverse is iterative; a slab of all matrices, 4 * 3N rows * bytes; and per
/// thread a few times the widest block of all of them.
double peak_bytes(const BodyGeometry& geometry, const PrecomputeOptions& options,
                  const StoredEstimate& stored);

}  // namespace bem
