#include "kernels/lag_product.hpp"

#include <catch2/catch.hpp>

using namespace bem;

TEST_CASE("products with polynomials have the weights of the product, closure included") {
  const std::array<double, 3> p = {0.7, -0.3, 1.9};
  const double lam = 2.3, tail = 0.4;
  for (const char* name : {"bdf1", "theta:0.4", "bdf2", "radau2", "radau3"})
    for (int last : {1, 3, 9}) {
      const Scheme scheme = Scheme::parse(name);
      const ContourQuadrature contour(scheme, last);
      const int count = contour.layout().count();
      // decays in lags, and does not vanish after the last one
      const auto x = [&](Complex d) {
        return std::exp(-d * lam) / (1.0 + d * tail) / (1.0 + d * tail);
      };
      std::vector<double> factor(count), exact(count), found(count);
      contour.weights(
          1, [&](Complex d, Complex* v) { *v = x(d); }, factor.data(), true);
      contour.weights(
          1, [&](Complex d, Complex* v) { *v = (p[0] + p[1] * d + p[2] * d * d) * x(d); },
          exact.data(), true);
      LagProduct(scheme, contour.layout(), p).apply(factor.data(), found.data());
      INFO(name << ", " << last << " lags");
      for (int lane = 0; lane < count; ++lane)
        CHECK(found[lane] == Approx(exact[lane]).margin(2e-11));
    }
}
