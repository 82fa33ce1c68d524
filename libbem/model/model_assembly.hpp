#pragma once

#include "model/memory_estimate.hpp"
#include "model/slab_assembly.hpp"

namespace bem {

/// Fills the matrices of a model, whose geometry, discretisation, codec, precision and loads are
/// set, and what the report says of them. As precompute().
void assemble_model(BodyModel& model, const PrecomputeOptions& options, const Progress& progress);

/// Far panels in single precision where neither storage nor tolerance asks for more.
AssemblyPrecision assembly_precision(const PrecomputeOptions& options);

/// Of the assembly alone, on all threads, from a few neighbouring rows.
double seconds_per_row(const BodyGeometry& geometry, const PrecomputeOptions& options);

/// Bytes of the large matrices that a codec will store, and the time that it will take to assemble
/// and compress them, from some rows; those of H_0^{-1} and H_0^{-1} G_0 are taken to be a fixed
/// part of those of H_0 and G_0.
StoredEstimate sample_compression(const BodyGeometry& geometry, const PrecomputeOptions& options);

}  // namespace bem
