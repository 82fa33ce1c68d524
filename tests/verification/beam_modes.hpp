#pragma once

#include "support/bodies.hpp"
#include "support/body_modes.hpp"

#include <cstdio>
#include <map>
#include <string>

namespace bem_test {

constexpr double kBeamLength = 1, kBeamWidth = 0.2, kBeamDensity = 1000;

struct BeamMaterial {
  double mu, nu;
  /// Free-free, in hertz: Timoshenko bending (shear factor 10 (1 + nu)/(12 + 11 nu)), two modes
  /// each; torsion 0.918402 c2/(2 L); Rayleigh-Love axial.
  double bending1, torsion1, bending2, axial1;

  bem::Material material() const { return bem_test::material(kBeamDensity, mu, nu); }
};
const BeamMaterial kSoftBeam{3e5, 0.45, 5.346, 7.954, 12.41, 14.651};
const BeamMaterial kStiffBeam{1e7, 0.30, 29.36, 45.920, 68.73, 80.385};

/// `across` cells over the width, five times as many along the length.
inline bem::TriangleMesh beam(int across) {
  return bem::box(bem::Vec3(kBeamLength, kBeamWidth, kBeamWidth), {5 * across, across, across});
}

/// Disc around the eigenfrequency i 2 pi f with a radius relative to it.
inline Disc disc_around(double hertz, double relative_radius) {
  const double omega = 2 * bem::kPi * hertz;
  return {bem::Complex(0, omega), relative_radius * omega};
}

/// What a mode shape (3N) mostly does: "bending" if its sections move sideways, "axial" if they
/// move along the beam, "torsion" if they turn about it.
inline std::string beam_motion(const bem::TriangleMesh& mesh, const Eigen::VectorXcd& shape) {
  struct Section {
    Eigen::Vector3cd sum = Eigen::Vector3cd::Zero();
    int count = 0;
  };
  std::map<long, Section> sections;
  double turning = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const bem::Vec3& x = mesh.vertices[i];
    const Eigen::Vector3cd u = shape.segment<3>(static_cast<Eigen::Index>(3 * i));
    Section& section = sections[std::lround(1e6 * x[0])];
    section.sum += u;
    ++section.count;
    const double arm = std::hypot(x[1], x[2]);
    if (arm > 0) turning += std::norm(x[1] * u[2] - x[2] * u[1]) / (arm * arm);
  }
  double along = 0, sideways = 0;
  for (const auto& [x, section] : sections) {
    along += std::norm(section.sum[0]) / section.count;
    sideways += section.sum.tail<2>().squaredNorm() / section.count;
  }
  const double total = shape.squaredNorm();
  if (sideways > 0.5 * total) return "bending";
  if (along > 0.5 * total) return "axial";
  return turning > 0.9 * total ? "torsion" : "";
}

/// Eigenfrequencies s [1/s] by the motion they belong to.
using BeamModes = std::map<std::string, std::vector<bem::Complex>>;

inline BeamModes beam_modes(const bem::TriangleMesh& mesh, const bem::Material& material,
                            const Disc& disc, const std::vector<int>& held = {}) {
  constexpr int kColumns = 12;
  ContourSearch search;
  search.points = 20;
  const auto n = static_cast<Eigen::Index>(3 * mesh.vertices.size());
  BeamModes values;
  for (const Eigenpair& p :
       body_modes(mesh, material, disc, random_block(n, kColumns), held, search)) {
    // the entries at held vertices are tractions
    Eigen::VectorXcd shape = p.vector;
    for (const int v : held) shape.segment<3>(3 * v).setZero();
    values[beam_motion(mesh, shape)].push_back(p.value);
  }
  return values;
}

/// Vertices of the end that is clamped, the one with the smallest x.
inline std::vector<int> clamped_end(const bem::TriangleMesh& mesh) {
  std::vector<int> held;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (mesh.vertices[i][0] < -0.4999 * kBeamLength) held.push_back(static_cast<int>(i));
  return held;
}

/// Prints and returns the modes of one kind of a free beam around a frequency [Hz] of beam theory.
inline ModeGroup print_beam_modes(int across, const BeamMaterial& b, const char* kind,
                                  double hertz) {
  const bem::TriangleMesh mesh = beam(across);
  BeamModes modes = beam_modes(mesh, b.material(), disc_around(hertz, 0.16));
  const ModeGroup g = group_of(modes[kind]);
  const double measured = g.mean.imag() / (2 * bem::kPi);
  std::printf("beam, %zu vertices, nu %.2f: %d %s %.3f Hz (%+.4f), damping %+.4f\n",
              mesh.vertices.size(), b.nu, g.count, kind, measured, measured / hertz - 1,
              -g.mean.real() / g.mean.imag());
  return g;
}

}  // namespace bem_test
