#pragma once

#include "model/precompute.hpp"

namespace bem {

/// Computes `energy_stiffness` and `energy_mass` of a model that has its other matrices, and stores
/// them with the codec so that energies of smooth motions are right to about 1e-4. Throws as
/// energy_matrices().
void add_energies(BodyModel& model, const PrecomputeOptions& options, const Progress& progress);

/// The codec of these matrices; `options`: of the others.
CodecOptions energy_codec(const CodecOptions& options);

}  // namespace bem
