#pragma once

#include "model/precompute.hpp"
#include "model/slab_assembly.hpp"

namespace bem {

/// Fills the matrices of a model, whose geometry, discretisation, codec, precision and loads are
/// set, and what the report says of them. As precompute().
void assemble_model(BodyModel& model, const PrecomputeOptions& options, const Progress& progress);

/// Far panels in single precision where neither storage nor tolerance asks for more.
AssemblyPrecision assembly_precision(const PrecomputeOptions& options);

}  // namespace bem
