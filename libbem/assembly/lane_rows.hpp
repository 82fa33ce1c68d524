#pragma once

#include "assembly/surface_patch.hpp"
#include "base/types.hpp"

namespace bem {

/// to[row] = sum of value from[item] over the entries of the row, for `size` numbers each, a
/// multiple of LaneTable<T>::kLanePadding.
void combine_rows(const SparseRows& rows, const double* from, std::size_t size, double* to);
void combine_rows(const SparseRows& rows, const float* from, std::size_t size, float* to);

/// out[3 axes x 6][padded lane] += J of tractions that are constant on y: `tractions` (3 x 6), and
/// `pressure` times the pressure kernel, from PairSums::uniform of a shape of x.
void add_strain(const double* uniform, int padded_lanes,
                const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure, double* out);
void add_strain(const float* uniform, int padded_lanes,
                const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure, float* out);

}  // namespace bem
