#include "kernels/hypersingular_functions.hpp"
#include "kernels/moments.hpp"
#include "kernels/radial_functions.hpp"
#include "support/collocation_kernels.hpp"
#include "support/galerkin_kernels.hpp"
#include "support/reference.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

double kappa_of(double nu) {
  return (1 - 2 * nu) / (2 * (1 - nu));
}

}  // namespace

TEST_CASE("hypersingular functions agree with the high-precision reference for every |z|") {
  const char* names[] = {"alpha", "beta", "gamma", "delta", "epsilon"};
  const json data = load_reference("discretisation.json")["radial_functions"]["values"];
  REQUIRE(data.size() == 24);
  double worst = 0;
  for (const json& p : data) {
    const auto v = hypersingular_values(complex(p["z"]), kappa_of(number(p["nu"])));
    for (int f = 0; f <= kEpsilon; ++f)
      worst = std::max(worst, std::abs(v[f] - complex(p[names[f]])) / (1 + std::abs(v[f])));
  }
  std::printf("hypersingular functions: largest error %.1e\n", worst);
  CHECK(worst < 2e-14);
}

TEST_CASE("dynamic parts of the adjoint kernel are those of the traction kernel") {
  for (double nu : {0.0, 0.3, 0.49, 0.5})
    for (const Complex z : {Complex(0.3, 0.2), Complex(2, 5), Complex(12, -20)}) {
      const double kappa = kappa_of(nu);
      const auto v = hypersingular_values(z, kappa);
      const auto radial = radial_values(z, kappa);
      const StaticTraction rest(kappa);
      CHECK(std::abs(rest.p + 0.5 * z * z * v[kAlpha] - radial[kRadialP]) < 1e-13);
      CHECK(std::abs(rest.q + z * z * v[kDynamicQ] - radial[kRadialQ]) < 1e-13);
      CHECK(std::abs(rest.s + z * z * v[kDynamicS] - radial[kRadialS]) < 1e-13);
      // K'(x, y) is the transposed traction kernel with the points exchanged, up to its sign
      const Vec3 x(0.1, 0.2, 0.3), y(0.7, -0.4, 1.1);
      const Vec3 m = Vec3(1, 2, -0.5).normalized(), n = Vec3(-0.3, 1, 2).normalized();
      const SurfacePair g = surface_pair(x, m, y, n);
      const Eigen::Matrix3cd whole = static_adjoint_kernel(g, rest).cast<Complex>() +
                                     (z * z / (g.r * g.r)) * dynamic_adjoint_kernel(g, v);
      const Eigen::Matrix3cd p = traction_kernel(pair_geometry(y, x, m), radial).transpose();
      CHECK((whole - p).cwiseAbs().maxCoeff() < 1e-13);
    }
}
