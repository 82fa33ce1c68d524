#pragma once

#include "kernels/contour.hpp"

#include <array>
#include <vector>

namespace bem {

/// Weights of p(s dt) X(s) from those of X, where p is a polynomial of degree 2: the series of
/// p(Delta(zeta)) ends after a few terms, so this is exact, closure included.
class LagProduct {
 public:
  /// p(d) = p[0] + p[1] d + p[2] d^2.
  LagProduct(const Scheme& scheme, const LaneLayout& layout, const std::array<double, 3>& p);

  /// Lanes of the product: out[lane] += sum of factor * in[lane'].
  struct Term {
    int to, from;
    double factor;
  };
  const std::vector<Term>& terms() const { return terms_; }  ///< by `to`, ascending

  /// out[lane] = the product's; in and out are layout.count() numbers, and different ones.
  template <class T>
  void apply(const T* in, double* out) const {
    apply(count_, in, out);
  }
  /// The same for the first lanes alone.
  template <class T>
  void apply(int lanes, const T* in, double* out) const {
    for (int lane = 0; lane < lanes; ++lane) out[lane] = 0;
    for (const Term& t : terms_) {
      if (t.to >= lanes) break;
      out[t.to] += t.factor * in[t.from];
    }
  }

 private:
  int count_;
  std::vector<Term> terms_;
};

}  // namespace bem
