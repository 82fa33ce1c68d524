// Free vibrations of a sphere: Lamb's frequencies against the eigenvalues of the discretised body,
// in space alone and in time.
#include "support/free_recursion.hpp"
#include "support/models.hpp"
#include "verification/sphere_modes.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

TEST_CASE("sphere: Lamb's modes with their multiplicities") {
  // 1.15 times the largest errors of docs/accuracy/vibrations.md with 42 vertices
  std::map<std::string, double> limits = {{"T2", 0.031}, {"S2", 0.016}, {"S1", 0.0125},
                                          {"T3", 0.032}, {"S3", 0.034}, {"S0", 0.0006}};
  const TriangleMesh mesh = unit_volume_icosphere(1);
  for (const double nu : {0.25, 0.30, 0.45, 0.49}) {
    FamilyValues modes = all_sphere_modes(mesh, nu);
    if (nu > 0.4) limits["S0"] = 0.0135;  // at more than twice the frequency
    for (const SphereFamily& f : sphere_families(nu)) {
      if (f.frequency > 20) continue;  // six elements around the sphere do not resolve it
      const ModeGroup g = group_of(modes[f.name]);
      CAPTURE(nu, f.name, g.mean);
      CHECK(g.count == f.multiplicity());
      CHECK(g.mean.imag() == Approx(f.frequency).epsilon(limits.at(f.name)));
      CHECK(std::abs(g.mean.real()) < 0.045 * f.frequency);
      CHECK(g.spread < 0.005);
    }
  }
}

TEST_CASE("sphere: frequencies converge with the mesh") {
  FamilyValues coarse = low_sphere_modes(unit_volume_icosphere(1), 0.3);
  FamilyValues fine = low_sphere_modes(unit_volume_icosphere(2), 0.3);
  for (const SphereFamily& f : sphere_families(0.3)) {
    if (coarse[f.name].empty()) continue;
    const auto error = [&f](const FamilyValues& modes) {
      return std::abs(group_of(modes.at(f.name)).mean - Complex(0, f.frequency)) / f.frequency;
    };
    const double order = std::log2(error(coarse) / error(fine));
    std::printf("sphere %s: error %.4f with 42 vertices, %.4f with 162, order %.2f\n", f.name,
                error(coarse), error(fine), order);
    CHECK(fine[f.name].size() == coarse[f.name].size());
    CHECK(order > 1.4);
    CHECK(error(fine) < 0.013);
  }
}

TEST_CASE("sphere: free motion per step is that of the scheme at the frequencies in space") {
  const double nu = 0.3, lam = 12;
  const BodyGeometry g = geometry_of(unit_volume_icosphere(1), 1);
  const FamilyValues space = low_sphere_modes(g.nodes, nu);
  for (const char* scheme : {"bdf1", "theta:0.75", "bdf2", "radau2"}) {
    PrecomputeOptions o = options_for(g, unit_material(nu), scheme, lam);
    const double dt = o.discretisation.dt;
    o.discretisation.history_length = 60;
    const FamilyValues all = low_factors(precompute(g, o));
    o.discretisation.history_length = default_history_length(o.discretisation.scheme, lam);
    const FamilyValues kept = low_factors(precompute(g, o));
    for (const char* family : {"T2", "S2"}) {
      const Complex w = group_of(space.at(family)).mean * dt;
      const Complex expected = amplification(o.discretisation.scheme, w);
      const auto deviation = [&](const FamilyValues& modes) {
        return std::abs(group_of(modes.at(family)).mean - expected) / std::abs(w);
      };
      std::printf("%-10s %s: all weights %.1e, %d lags %.1e\n", scheme, family, deviation(all),
                  o.discretisation.history_length, deviation(kept));
      CHECK(all.at(family).size() == 5);
      CHECK(kept.at(family).size() == 5);
      CHECK(deviation(all) < 1e-7);
      CHECK(deviation(kept) < 0.02);
    }
  }
}
