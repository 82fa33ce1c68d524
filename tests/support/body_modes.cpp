#include "support/body_modes.hpp"

#include "mesh/extent.hpp"

namespace bem_test {

Eigen::MatrixXcd boundary_matrix(const bem::TriangleMesh& mesh, const bem::Material& material,
                                 bem::Complex s, const std::vector<int>& held) {
  constexpr double kQuadratureTolerance = 1e-6;
  bem::LaplaceMatrices m = bem::laplace_matrices(mesh, material, s, kQuadratureTolerance);
  const double scale = material.shear_modulus / bem::longest_edge(mesh, mesh.triangles[0]);
  for (const int v : held) m.h.middleCols<3>(3 * v) = -scale * m.g.middleCols<3>(3 * v);
  return std::move(m.h);
}

std::vector<Eigenpair> body_modes(const bem::TriangleMesh& mesh, const bem::Material& material,
                                  const Disc& disc, const Eigen::MatrixXcd& block,
                                  const std::vector<int>& held, const ContourSearch& search) {
  const double reach = disc.radius * bem::diameter(mesh.vertices) / material.shear_speed();
  int assemblies = 1;
  for (double error = reach; error > 1e-8; error *= reach / assemblies) ++assemblies;
  const MatrixPolynomial h([&](bem::Complex s) { return boundary_matrix(mesh, material, s, held); },
                           disc, assemblies);
  return eigenpairs_in_disc(h, disc, block, search);
}

ModeGroup group_of(const std::vector<bem::Complex>& values) {
  ModeGroup g;
  g.count = static_cast<int>(values.size());
  for (const bem::Complex& v : values) g.mean += v / static_cast<double>(g.count);
  for (const bem::Complex& v : values)
    g.spread = std::max(g.spread, std::abs(v - g.mean) / std::abs(g.mean));
  return g;
}

}  // namespace bem_test
