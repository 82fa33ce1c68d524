#pragma once

#include "assembly/surface_patch.hpp"

namespace bem {

/// Rows of a patch of x that are wanted: those of nodes [first, last).
struct PatchRows {
  std::vector<int> rows;  ///< counted from the first wanted row, ascending
  SparseRows shapes, midpoints;
  std::array<SparseRows, 3> curls_at;  ///< of SurfacePatch, wanted rows alone

  PatchRows(const SurfacePatch& patch, int first, int last);
};

}  // namespace bem
