#pragma once

#include "model/assembly_targets.hpp"
#include "model/precompute.hpp"

namespace bem {

/// The eigenvalue of D(0) [N/m] of the softest quadratic displacement, bending if the body is
/// slender or thin; a little too large.
double least_stiffness(const BodyModel& model);

/// Targets of a model whose codec is sampled: its builders learn from the rows of one slab, which
/// the assembler makes for them, how much they may lose. `slabs` must outlive them.
AssemblyTargets<float> sampled_targets(SlabAssembler<float>& assembler,
                                       const std::vector<Slab>& slabs, const BodyModel& model,
                                       const PrecomputeOptions& options);

}  // namespace bem
