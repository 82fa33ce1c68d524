#pragma once

#include "model/memory_estimate.hpp"

namespace bem {

/// Fills the matrices of a model, whose geometry, discretisation, codec, precision and loads are
/// set, and what the report says of them. As precompute().
void assemble_model(BodyModel& model, const PrecomputeOptions& options, const Progress& progress);

/// Bytes of the large matrices that a codec will store, and the time that it will take to assemble
/// and compress them, from some rows; those of H_0^{-1} and H_0^{-1} G_0 are taken to be a fixed
/// part of those of H_0 and G_0.
StoredEstimate sample_compression(const BodyGeometry& geometry, const PrecomputeOptions& options);

}  // namespace bem
