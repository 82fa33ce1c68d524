#pragma once

#include "mesh/extent.hpp"
#include "support/laplace_assembly.hpp"
#include "support/nonlinear_eigenvalues.hpp"

#include <vector>

namespace bem_test {

/// H(s) of a body in a stationary frame; it is singular where s is an eigenfrequency. Vertices in
/// `held` do not move: their columns are those of the unknown tractions, -G(s), scaled to the size
/// of H.
inline Eigen::MatrixXcd boundary_matrix(const bem::TriangleMesh& mesh,
                                        const bem::Material& material, bem::Complex s,
                                        const std::vector<int>& held = {}) {
  constexpr double kQuadratureTolerance = 1e-6;
  bem::LaplaceMatrices m = bem::laplace_matrices(mesh, material, s, kQuadratureTolerance);
  const double scale = material.shear_modulus / bem::longest_edge(mesh, mesh.triangles[0]);
  for (const int v : held) m.h.middleCols<3>(3 * v) = -scale * m.g.middleCols<3>(3 * v);
  return std::move(m.h);
}

/// Eigenfrequencies s [1/s] in a disc, and mode shapes, of the body as it is discretised in space.
/// The disc must not contain s = 0, where the six rigid motions are. Cost: 7 to 12 assemblies for
/// discs up to c2/extent, between which H(s) is interpolated with an error of 1e-8, and the
/// factorisations of the search.
inline std::vector<Eigenpair> body_modes(const bem::TriangleMesh& mesh,
                                         const bem::Material& material, const Disc& disc,
                                         const Eigen::MatrixXcd& block,
                                         const std::vector<int>& held = {},
                                         const ContourSearch& search = {}) {
  const double reach = disc.radius * bem::diameter(mesh.vertices) / material.shear_speed();
  int assemblies = 1;
  for (double error = reach; error > 1e-8; error *= reach / assemblies) ++assemblies;
  const MatrixPolynomial h([&](bem::Complex s) { return boundary_matrix(mesh, material, s, held); },
                           disc, assemblies);
  return eigenpairs_in_disc(h, disc, block, search);
}

/// Several eigenvalues that are one in the continuum.
struct ModeGroup {
  int count = 0;
  bem::Complex mean = 0;
  double spread = 0;  ///< largest distance from the mean, relative to it
};

inline ModeGroup group_of(const std::vector<bem::Complex>& values) {
  ModeGroup g;
  g.count = static_cast<int>(values.size());
  for (const bem::Complex& v : values) g.mean += v / static_cast<double>(g.count);
  for (const bem::Complex& v : values)
    g.spread = std::max(g.spread, std::abs(v - g.mean) / std::abs(g.mean));
  return g;
}

}  // namespace bem_test
