#pragma once

#include "compress/block_partition.hpp"
#include "compress/codec.hpp"
#include "compress/family_builder.hpp"

namespace bem {

/// The builder of a codec that needs to know nothing of the matrices beforehand: none, or haar for
/// single precision. For rows in the slabs of direct_slabs().
template <class T>
std::unique_ptr<FamilyBuilder<T>> make_direct_builder(const CodecOptions& options, int nodes,
                                                      int count);

/// Ranges of nodes, without blocks.
std::vector<Slab> direct_slabs(const CodecOptions& options, int nodes);

}  // namespace bem
