// Tables of docs/accuracy/vibrations.md: frequencies of spheres and beams over meshes, materials,
// schemes and time steps.
#include "verification/clamped_beam.hpp"
#include "verification/sphere_modes.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

/// Prints errors of the frequencies of a sphere; returns the number of modes that were found.
int sphere_table(int subdivisions, double nu) {
  const TriangleMesh mesh = unit_volume_icosphere(subdivisions);
  FamilyValues modes = all_sphere_modes(mesh, nu);
  int found = 0;
  for (const SphereFamily& f : sphere_families(nu)) {
    const ModeGroup g = group_of(modes[f.name]);
    found += g.count;
    if (g.count == 0) continue;
    std::printf("sphere, %zu vertices, nu %.2f: %d %s %.5f (%+.4f), damping %+.4f, spread %.4f\n",
                mesh.vertices.size(), nu, g.count, f.name, g.mean.imag(),
                g.mean.imag() / f.frequency - 1, -g.mean.real() / std::abs(g.mean), g.spread);
  }
  return found;
}

/// Prints how T2 moves in time; returns the error of its frequency against that in space.
double time_row(const BodyGeometry& g, const char* scheme, double lam, Complex in_space) {
  const PrecomputeOptions o = options_for(g, unit_material(0.3), scheme, lam);
  const double dt = o.discretisation.dt, omega = in_space.imag();
  const ModeGroup t2 = group_of(low_factors(precompute(g, o))["T2"]);
  const Complex z = t2.mean, expected = amplification(o.discretisation.scheme, in_space * dt);
  const double error = std::arg(z) / (omega * dt) - 1;
  const double period = 2 * kPi / (omega * dt);
  std::printf(
      "%-10s %.1f steps per period, %d lags: frequency %+.5f, amplitude after a period %.4f, of "
      "the "
      "scheme alone %.4f, deviation from all weights %.1e\n",
      scheme, period, o.discretisation.history_length, error,
      std::pow(std::abs(z), period) / std::exp(period * in_space.real() * dt),
      std::pow(std::abs(expected), period) / std::exp(period * in_space.real() * dt),
      std::abs(z - expected) / std::abs(in_space * dt));
  return error;
}

}  // namespace

TEST_CASE("modes of spheres over meshes and materials") {
  constexpr int kModes = 28;
  for (const double nu : {0.25, 0.30, 0.45, 0.49})
    for (const int subdivisions : {1, 2}) {
      // the breathing mode of nu = 0.49 is too high for these meshes
      const int found = sphere_table(subdivisions, nu);
      CHECK(found >= (nu < 0.49 ? kModes : kModes - 1));
    }
  for (const double nu : {0.30, 0.45}) CHECK(sphere_table(3, nu) == kModes);
}

TEST_CASE("modes of a sphere in time") {
  const BodyGeometry g = geometry_of(unit_volume_icosphere(1), 1);
  const Complex t2 = group_of(low_sphere_modes(g.nodes, 0.3).at("T2")).mean;
  const std::pair<const char*, double> orders[] = {
      {"bdf1", 2}, {"theta:0.75", 2}, {"bdf2", 2}, {"radau2", 3}};
  for (const auto& [scheme, order] : orders) {
    double errors[3];
    for (int i = 0; i < 3; ++i) errors[i] = time_row(g, scheme, 8 << i, t2);
    CHECK(std::log2(errors[1] / errors[2]) > order - 0.5);
  }
}

TEST_CASE("modes of beams") {
  for (const BeamMaterial& b : {kSoftBeam, kStiffBeam})
    for (const int across : {2, 4}) {
      CHECK(print_beam_modes(across, b, "bending", b.bending1).count == 2);
      CHECK(print_beam_modes(across, b, "torsion", b.torsion1).count == 1);
      CHECK(print_beam_modes(across, b, "bending", b.bending2).count == 2);
      CHECK(print_beam_modes(across, b, "axial", b.axial1).count == 1);
    }
  CHECK(print_beam_modes(6, kSoftBeam, "bending", kSoftBeam.bending1).count == 2);
}

TEST_CASE("clamped beams") {
  for (const ClampedBeam& b : {kSoftClamped, kStiffClamped})
    for (const int across : {2, 4}) {
      const TriangleMesh mesh = beam(across);
      BeamModes modes =
          beam_modes(mesh, b.material.material(), disc_around(b.bending1, 0.3), clamped_end(mesh));
      const ModeGroup g = group_of(modes["bending"]);
      std::printf(
          "clamped beam in a stationary frame, %d cells, nu %.2f: %d bending %.4f Hz "
          "(%+.4f), damping %+.4f\n",
          across, b.material.nu, g.count, g.mean.imag() / (2 * kPi),
          g.mean.imag() / (2 * kPi) / b.bending1 - 1, -g.mean.real() / g.mean.imag());
      CHECK(g.count == 2);
      const double rest = resting_deflection(b, across);
      for (const double window : {1.0, 0.997, 0.0})
        CHECK(print_ringing(b, across, rest, window).peak == Approx(2 * rest).epsilon(0.06));
      for (const char* scheme : {"bdf2", "theta:0.75"})
        CHECK(print_ringing(b, across, rest, 1, scheme).peak == Approx(2 * rest).epsilon(0.06));
    }
}
