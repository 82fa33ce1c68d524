#pragma once

#include "model/precompute.hpp"

namespace bem {

/// Bytes of the matrices that precompute() will store. Exact for codec "none"; for "lowrank" from
/// those of bodies that were measured (docs/performance.md), mostly right to a quarter; for "haar"
/// from its ratio, and with a tolerance what they take uncompressed.
double stored_bytes(const BodyGeometry& geometry, const PrecomputeOptions& options);

/// What of it is more than an estimate: all, or nothing for a codec that is sampled.
double certain_bytes(const BodyGeometry& geometry, const PrecomputeOptions& options);

/// Bytes of the largest working set of precompute() when the matrices take `stored`.
///
/// Codec "none": the matrices of all lags, and of lag 0 the complex ones that are factorised.
/// Compressed: what is stored at the end of the assembly; H_0 of all components, 8 or 16 (3N)^2
/// bytes, unless the inverse is iterative; a slab of all matrices, 4 * 3N rows * bytes; and per
/// thread a few times the widest block of all of them.
double peak_bytes(const BodyGeometry& geometry, const PrecomputeOptions& options, double stored);

}  // namespace bem
