#pragma once

#include <vector>

namespace bem {

/// Gauss-Legendre rule on [0, 1], exact for polynomials of degree 2 n - 1.
struct GaussRule {
  std::vector<double> nodes, weights;
};

/// n >= 1 nodes, by Newton's method on the Legendre polynomial; accurate to rounding.
GaussRule gauss_rule(int n);

}  // namespace bem
