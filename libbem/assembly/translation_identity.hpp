#pragma once

#include "kernels/contour.hpp"

namespace bem {

/// Row sums that the H lanes must have so that rigid translation is exact, from the same entry of
/// the D lanes (both [lane], layout of `scheme`):  H(zeta) T = -(Delta(zeta)/dt)^2 D(zeta)  (M43),
/// with the closure of the last lag taken into account.
void translation_row_sums(const Scheme& scheme, const LaneLayout& layout, double dt,
                          const double* d, double* row_sums);

}  // namespace bem
