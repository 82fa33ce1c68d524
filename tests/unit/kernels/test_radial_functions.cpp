#include "kernels/moments.hpp"
#include "kernels/radial_functions.hpp"
#include "support/collocation_kernels.hpp"
#include "support/reference.hpp"

#include <catch2/catch.hpp>

using namespace bem_test;
using bem::Complex;

namespace {

struct Setup {
  bem::PairGeometry pair;
  double mu, kappa, c2;
  Complex z2;
};

long double extended(const json& j) {
  return j.is_string() ? std::stold(j.get<std::string>()) : j.get<double>();
}

/// z2 = s r/c2 in extended precision, so that only its final rounding enters the comparison.
Complex argument(const json& p) {
  long double rr = 0;
  for (int i = 0; i < 3; ++i) {
    const long double d = extended(p["y"][i]) - extended(p["x"][i]);
    rr += d * d;
  }
  const long double scale = std::sqrt(rr * extended(p["rho"]) / extended(p["mu"]));
  return Complex(static_cast<double>(scale * extended(p["s"][0])),
                 static_cast<double>(scale * extended(p["s"][1])));
}

Setup read_setup(const json& p) {
  Setup t;
  t.mu = number(p["mu"]);
  const double nu = number(p["nu"]);
  t.kappa = (1 - 2 * nu) / (2 * (1 - nu));
  t.c2 = std::sqrt(t.mu / number(p["rho"]));
  t.z2 = argument(p);
  t.pair = bem::pair_geometry(vec3(p["x"]), vec3(p["y"]), vec3(p["n"]));
  return t;
}

}  // namespace

TEST_CASE("radial functions agree with the high-precision reference for every |z|") {
  const char* names[] = {"a", "b", "P", "Q", "S", "F", "h2", "m02"};
  const json data = load_reference("kernels.json");
  REQUIRE(data["points"].size() == 40);
  double worst = 0;
  for (const json& p : data["points"]) {
    const Setup t = read_setup(p);
    const auto v = bem::radial_values(t.z2, t.kappa);
    for (int f = 0; f < bem::kRadialC0; ++f)
      worst = std::max(worst, std::abs(v[f] - complex(p["radial"][names[f]])));
    const bem::Complex z1 = std::sqrt(t.kappa) * t.z2;
    worst =
        std::max(worst, std::abs(v[bem::kRadialC0] - t.kappa * bem::exponential_moments(z1).m0));
  }
  CHECK(worst / 3 < 3.3e-15);  // the largest static value is |S| = 3
}

TEST_CASE("kernel tensors agree with the high-precision reference, relative to their static size") {
  const json data = load_reference("kernels.json");
  double worst = 0;
  for (const json& p : data["points"]) {
    const Setup t = read_setup(p);
    const auto v = bem::radial_values(t.z2, t.kappa);
    const auto rest = bem::static_radial_values(t.kappa);
    const auto error = [&worst](const auto& value, const json& exact, double size) {
      worst = std::max(worst, (value - matrix3(exact)).norm() / size);
    };
    error(bem::displacement_kernel(t.pair, v, t.mu), p["u"],
          bem::displacement_kernel(t.pair, rest, t.mu).norm());
    // the size of the static traction kernel apart from the chance cancellation for small h.n
    const double sizes = std::abs(rest[bem::kRadialP]) + std::abs(rest[bem::kRadialQ]) +
                         std::abs(rest[bem::kRadialS]);
    error(bem::traction_kernel(t.pair, v), p["p"], sizes / (4 * bem::kPi * t.pair.r * t.pair.r));
    error(bem::translation_kernel(t.pair, v, t.c2), p["d"],
          bem::translation_kernel(t.pair, rest, t.c2).norm());
    error(bem::rotation_kernel(t.pair, v, t.c2), p["l"],
          bem::rotation_kernel(t.pair, rest, t.c2).norm());
  }
  CHECK(worst < 3.3e-15);
}

TEST_CASE("the row index of the traction kernel is the direction of the force") {
  // Hooke's law for Kelvin's solution by central differences: sigma n with displacement u*_i.
  const double nu = 0.3, mu = 1.7, kappa = (1 - 2 * nu) / (2 * (1 - nu));
  const double lambda = 2 * mu * nu / (1 - 2 * nu);
  const bem::Vec3 x(0.1, -0.2, 0.3), y(0.9, 0.4, -0.1), n = bem::Vec3(1, -2, 2) / 3;
  const auto rest = bem::static_radial_values(kappa);
  const auto displacement = [&](const bem::Vec3& at) -> bem::Mat3 {
    return bem::displacement_kernel(bem::pair_geometry(x, at, n), rest, mu);
  };
  const double step = 1e-5;
  bem::Mat3 gradient[3];  // gradient[l] = d u*/d y_l
  for (int l = 0; l < 3; ++l) {
    const bem::Vec3 e = step * bem::Vec3::Unit(l);
    gradient[l] = (displacement(y + e) - displacement(y - e)) / (2 * step);
  }
  bem::Mat3 traction;
  for (int i = 0; i < 3; ++i) {
    bem::Mat3 strain;
    for (int j = 0; j < 3; ++j)
      for (int l = 0; l < 3; ++l) strain(j, l) = 0.5 * (gradient[l](i, j) + gradient[j](i, l));
    const bem::Mat3 stress = 2 * mu * strain + lambda * strain.trace() * bem::Mat3::Identity();
    traction.row(i) = (stress * n).transpose();
  }
  const bem::Mat3 kernel = bem::traction_kernel(bem::pair_geometry(x, y, n), rest);
  CHECK((kernel - traction).norm() / traction.norm() < 1e-8);
  CHECK((kernel.transpose() - traction).norm() / traction.norm() > 0.1);
}
