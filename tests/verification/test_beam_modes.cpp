// Beam of 1 x 0.2 x 0.2 m: free vibrations, and a clamped one under gravity that sets in suddenly.
#include "verification/clamped_beam.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

/// Checks the modes of one kind around a frequency [Hz] of beam theory; returns their mean error.
double check_modes(int across, const BeamMaterial& b, const char* kind, double hertz,
                   double limit) {
  const ModeGroup g = print_beam_modes(across, b, kind, hertz);
  const double error = g.mean.imag() / (2 * kPi * hertz) - 1;
  CHECK(g.count == (std::string(kind) == "bending" ? 2 : 1));
  CHECK(g.spread < 1e-5);
  CHECK(std::abs(error) < limit);
  CHECK(std::abs(g.mean.real()) < 0.013 * g.mean.imag());
  return error;
}

}  // namespace

TEST_CASE("beam: free vibrations") {
  // two cells over the width; limits: 1.1 times the errors of docs/accuracy/vibrations.md
  for (const BeamMaterial& b : {kSoftBeam, kStiffBeam}) {
    check_modes(2, b, "bending", b.bending1, 0.14);
    check_modes(2, b, "torsion", b.torsion1, 0.09);
    check_modes(2, b, "bending", b.bending2, 0.13);
    check_modes(2, b, "axial", b.axial1, 0.0085);
  }
}

TEST_CASE("beam: frequencies converge with the mesh") {
  const double coarse = check_modes(2, kSoftBeam, "bending", kSoftBeam.bending1, 0.11);
  const double fine = check_modes(4, kSoftBeam, "bending", kSoftBeam.bending1, 0.035);
  CHECK(std::log2(coarse / fine) > 1.5);
}

TEST_CASE("clamped beam: gravity that sets in suddenly") {
  for (const ClampedBeam& b : {kSoftClamped, kStiffClamped}) {
    const double rest = resting_deflection(b, 2);
    CHECK(rest == Approx(b.deflection).epsilon(0.055));
    const Ringing r = print_ringing(b, 2, rest, 1);
    CHECK(r.hertz == Approx(b.bending1).epsilon(0.04));
    CHECK(r.peak == Approx(2 * rest).epsilon(0.06));
    CHECK(r.centre == Approx(rest).epsilon(0.015));
    CHECK(r.growth < 1.18);  // the mesh feeds the bending, docs/accuracy/vibrations.md
  }
}
