#include "assembly/patch_rows.hpp"

namespace bem {

PatchRows::PatchRows(const SurfacePatch& patch, int first, int last) {
  for (int k = 0; k < static_cast<int>(patch.nodes.size()); ++k) {
    if (patch.nodes[k] < first || patch.nodes[k] >= last) continue;
    rows.push_back(patch.nodes[k] - first);
    shapes.add_row(patch.displacements, k);
    midpoints.add_row(patch.displacements_at, k);
    for (int axis = 0; axis < 3; ++axis) curls_at[axis].add_row(patch.curls_at[axis], k);
  }
}

}  // namespace bem
