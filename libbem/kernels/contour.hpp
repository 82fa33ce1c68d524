#pragma once

#include "kernels/scheme.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace bem {

/// Numbering of the real numbers that represent all weights of one transfer function: first the
/// initial components (real part, and imaginary part of a pair), then the components of lag 1, 2,
/// ...
struct LaneLayout {
  LaneLayout(const Scheme& scheme, int last_lag);

  int initial;     ///< real lanes of lag 0
  int components;  ///< lanes of every later lag
  int last_lag;

  int lane(int lag, int component) const { return initial + (lag - 1) * components + component; }
  int count() const { return initial + last_lag * components; }
};

/// Factors that make the static value X(0) out of the lanes of a closed sequence of weights.
std::vector<double> static_lane_factors(const Scheme& scheme, const LaneLayout& layout);

/// The static value of columns that are given at lag 0 by initial component (n x inputs) and by
/// component at the later lags.
Eigen::MatrixXd static_columns(const Scheme& scheme, const LaneLayout& layout,
                               const std::vector<Eigen::MatrixXcd>& initial,
                               const std::vector<Eigen::MatrixXd>& lags);

/// Convolution quadrature weights of arbitrary transfer functions by the contour formula (M9) with
/// L = 4 (last_lag + 1) points and aliasing parameter 1e-14: absolute error about 1e-14 of the
/// function's size. Immutable after construction; weights() may be called from several threads.
class ContourQuadrature {
 public:
  /// Fills value[0..count) with the transfer functions at an eigenvalue d of Delta, i.e. at s =
  /// d/dt.
  using TransferFunctions = std::function<void(Complex d, Complex* value)>;

  ContourQuadrature(const Scheme& scheme, int last_lag);
  ~ContourQuadrature();

  /// out[f*layout().count() + lane] = weight of function f. With `closed`, the sum of all later
  /// weights is added to the last lag, so that sum_k X_k = X(Delta(1)/dt) exactly (M25).
  void weights(int count, const TransferFunctions& functions, double* out,
               bool closed = false) const;

  const LaneLayout& layout() const { return layout_; }

 private:
  /// Eigenvalues of Delta at one contour point and the components of their spectral projectors.
  struct Point {
    StageVectorC eigenvalues;
    std::vector<ComponentVectorC> components;  // one per eigenvalue
  };
  struct Transform;

  Point spectral_point(Complex zeta) const;
  void add_closure(int count, const TransferFunctions& functions, double* out) const;

  Scheme scheme_;
  LaneLayout layout_;
  int length_;
  double radius_;
  std::vector<Point> points_;
  Point at_zero_, at_one_;
  std::unique_ptr<Transform> transform_;
};

}  // namespace bem
