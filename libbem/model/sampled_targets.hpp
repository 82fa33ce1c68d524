#pragma once

#include "model/assembly_targets.hpp"
#include "model/precompute.hpp"

namespace bem {

/// Targets of a model whose codec is sampled: its builders learn from the rows of one slab, which
/// the assembler makes for them, how much they may lose. `slabs` must outlive them.
AssemblyTargets<float> sampled_targets(SlabAssembler<float>& assembler,
                                       const std::vector<Slab>& slabs, const BodyModel& model,
                                       const PrecomputeOptions& options);

}  // namespace bem
