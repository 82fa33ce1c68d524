#pragma once

#include "model/precompute.hpp"

namespace bem {

/// Fills the matrices of a model, whose geometry, discretisation, codec, precision and loads are
/// set, and what the report says of them. As precompute().
void assemble_model(BodyModel& model, const PrecomputeOptions& options, const Progress& progress);

}  // namespace bem
