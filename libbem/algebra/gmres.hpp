#pragma once

#include "base/types.hpp"

#include <functional>

namespace bem {

struct GmresOptions {
  double tolerance = 1e-12;  ///< of the residual, relative to the right-hand side
  int most_iterations = 200;
  int patience = 15;  ///< iterations in which the residual has to halve, else rounding is to blame
};

/// How the solution of several systems went.
struct GmresResult {
  double residual = 0;  ///< largest, relative
  int iterations = 0;
};

template <class T>
using ColumnsOf = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
/// A linear map of several vectors at a time.
template <class T>
using ColumnOperator = std::function<ColumnsOf<T>(const ColumnsOf<T>&)>;

/// Solves a x = b for several right-hand sides at once (n x count, each with a Krylov space of its
/// own) by GMRES without restarts (Saad & Schultz 1986), from the x that is given, with the right
/// preconditioner `precondition`, about a^{-1}, if there is one. Ends early when rounding keeps the
/// residuals from falling. Memory: n x count numbers per iteration. T: double, Complex.
template <class T>
GmresResult gmres(const ColumnOperator<T>& apply, const ColumnsOf<T>& b, ColumnsOf<T>& x,
                  const GmresOptions& options, const ColumnOperator<T>& precondition = nullptr);

}  // namespace bem
