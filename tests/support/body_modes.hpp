#pragma once

#include "support/laplace_assembly.hpp"
#include "support/nonlinear_eigenvalues.hpp"

#include <vector>

namespace bem_test {

/// H(s) of a body in a stationary frame; it is singular where s is an eigenfrequency. Vertices in
/// `held` do not move: their columns are those of the unknown tractions, -G(s), scaled to the size
/// of H.
Eigen::MatrixXcd boundary_matrix(const bem::TriangleMesh& mesh, const bem::Material& material,
                                 bem::Complex s, const std::vector<int>& held = {});

/// Eigenfrequencies s [1/s] in a disc, and mode shapes, of the body as it is discretised in space.
/// The disc must not contain s = 0, where the six rigid motions are. Cost: 7 to 12 assemblies for
/// discs up to c2/extent, between which H(s) is interpolated with an error of 1e-8, and the
/// factorisations of the search.
std::vector<Eigenpair> body_modes(const bem::TriangleMesh& mesh, const bem::Material& material,
                                  const Disc& disc, const Eigen::MatrixXcd& block,
                                  const std::vector<int>& held = {},
                                  const ContourSearch& search = {});

/// Several eigenvalues that are one in the continuum.
struct ModeGroup {
  int count = 0;
  bem::Complex mean = 0;
  double spread = 0;  ///< largest distance from the mean, relative to it
};

ModeGroup group_of(const std::vector<bem::Complex>& values);

}  // namespace bem_test
