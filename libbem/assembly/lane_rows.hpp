#pragma once

#include "assembly/surface_patch.hpp"
#include "base/types.hpp"

namespace bem {

/// to[row] = sum of value from[item] over the entries of the row, for `size` numbers each, which
/// are a multiple of 32 bytes. `stride`: numbers from one item to the next.
void combine_rows(const SparseRows& rows, const double* from, std::size_t stride, std::size_t size,
                  double* to);
void combine_rows(const SparseRows& rows, const float* from, std::size_t stride, std::size_t size,
                  float* to);
template <class T>
void combine_rows(const SparseRows& rows, const T* from, std::size_t size, T* to) {
  combine_rows(rows, from, size, size, to);
}

/// to[rows_of_to[row]] += part times the same.
void add_combined_rows(const SparseRows& rows, const double* from, std::size_t size, double part,
                       const std::vector<int>& rows_of_to, double* to);
void add_combined_rows(const SparseRows& rows, const float* from, std::size_t size, double part,
                       const std::vector<int>& rows_of_to, float* to);

/// out[3 axes x 6][lane] += J of tractions that are constant on y: `tractions` (3 x 6), and
/// `pressure` times the pressure kernel, from PairSums::uniform of a shape of x.
void add_strain(const double* uniform, std::size_t lanes,
                const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure, double* out);
void add_strain(const float* uniform, std::size_t lanes,
                const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure, float* out);

}  // namespace bem
