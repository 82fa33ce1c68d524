#pragma once

#include <cstddef>

namespace bem {

/// Right-hand sides that one pass over a matrix serves at most.
inline constexpr int kMaxRightHandSides = 4;

/// y[c*y_stride + i] += sum_j a[i*row_stride + j] x[c*x_stride + j] for rows i in [0, rows),
/// columns j in [0, columns) and right-hand sides c in [0, count), count <= kMaxRightHandSides. The
/// matrix is row-major, in single or double precision, and read exactly once; products and sums are
/// in double precision. Pure, single threaded, on the widest vector unit of the machine; the result
/// of a row depends on nothing but that row.
void multiply_rows(const float* a, std::size_t rows, std::size_t columns, std::size_t row_stride,
                   const double* x, std::size_t x_stride, double* y, std::size_t y_stride,
                   int count);
void multiply_rows(const double* a, std::size_t rows, std::size_t columns, std::size_t row_stride,
                   const double* x, std::size_t x_stride, double* y, std::size_t y_stride,
                   int count);

/// y[i] += sum_c columns[c][first + i] x[c] for i in [0, rows), c in [0, count). Every entry is
/// read once; sums in double precision. Pure, single threaded, on the widest vector unit; the
/// result of a row depends on nothing but that row.
void add_columns(const float* const* columns, std::size_t count, std::size_t first,
                 std::size_t rows, const double* x, double* y);
void add_columns(const double* const* columns, std::size_t count, std::size_t first,
                 std::size_t rows, const double* x, double* y);

}  // namespace bem
