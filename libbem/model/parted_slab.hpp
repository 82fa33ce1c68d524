#pragma once

#include "assembly/far_field.hpp"
#include "assembly/galerkin_rows.hpp"
#include "compress/block_partition.hpp"

namespace bem {

/// A slab of which distant blocks are found in factors. Columns that are too close for that are
/// computed in full, and what other columns their blocks have is multiplied out.
struct PartedSlab {
  int first = 0, last = 0;          ///< nodes
  std::vector<NodeBlock> distant;   ///< whole blocks, which remain in factors
  std::vector<NodeBlock> expanded;  ///< parts of other blocks

  /// Of both kinds of blocks.
  double entries() const;
  /// Columns that are computed in full; those and the expanded ones.
  RowColumns near_columns(int nodes) const;
  RowColumns stored_columns(int nodes) const;
};

PartedSlab part_slab(const Slab& slab, const FarField& far_field, int nodes);

/// What there is to do for the distant blocks of a slab, then for the expanded ones. `loaded`: by
/// node, as in FarTask; it and the patches must outlive the tasks.
std::vector<FarTask> far_tasks(const PartedSlab& slab, const std::vector<SurfacePatch>& patches,
                               const std::vector<char>& loaded, int nodes);

}  // namespace bem
