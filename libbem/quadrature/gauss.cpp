#include "quadrature/gauss.hpp"

#include "base/error.hpp"
#include "base/types.hpp"

#include <cmath>

namespace bem {

GaussRule gauss_rule(int n) {
  require(n >= 1, "a Gauss rule has at least one node");
  GaussRule rule;
  rule.nodes.resize(n);
  rule.weights.resize(n);
  for (int i = 0; i < n; ++i) {
    double x = std::cos(kPi * (i + 0.75) / (n + 0.5));
    double derivative = 1;
    for (int iteration = 0; iteration < 100; ++iteration) {
      double p0 = 1, p1 = x;  // Legendre polynomials of degree k-1 and k
      for (int k = 2; k <= n; ++k) {
        const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
        p0 = p1;
        p1 = p2;
      }
      derivative = n * (x * p1 - p0) / (x * x - 1);
      const double step = p1 / derivative;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    rule.nodes[i] = 0.5 * (1 - x);
    rule.weights[i] = 1 / ((1 - x * x) * derivative * derivative);
  }
  return rule;
}

}  // namespace bem
