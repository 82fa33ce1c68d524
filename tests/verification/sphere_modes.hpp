#pragma once

#include "support/bodies.hpp"
#include "support/body_modes.hpp"
#include "support/free_recursion.hpp"
#include "verification/sphere_shapes.hpp"

namespace bem_test {

/// A family of modes of a free sphere: torsional (T) or spheroidal (S) and angular degree; 2 degree
/// + 1 modes of one frequency.
struct SphereFamily {
  const char* name;
  double frequency;  ///< x = w a/c2, first of its kind

  int multiplicity() const { return 2 * (name[1] - '0') + 1; }
};

/// Roots of Lamb's frequency equations for nu = 0.25, 0.30, 0.45, 0.49.
inline std::vector<SphereFamily> sphere_families(double nu) {
  const int i = nu == 0.25 ? 0 : nu == 0.30 ? 1 : nu == 0.45 ? 2 : 3;
  const double s2[] = {2.63987, 2.64622, 2.66150, 2.66483};
  const double s1[] = {3.42453, 3.52999, 3.79751, 3.85630};
  const double s3[] = {3.91634, 3.93740, 3.98824, 3.99930};
  const double s0[] = {4.44000, 4.99551, 10.00522, 22.25429};
  return {{"T2", 2.50113}, {"S2", s2[i]}, {"S1", s1[i]},
          {"T3", 3.86470}, {"S3", s3[i]}, {"S0", s0[i]}};
}

/// Icosphere with the volume of the sphere of radius 1: its modes are compared with that sphere's.
inline bem::TriangleMesh unit_volume_icosphere(int subdivisions) {
  bem::TriangleMesh mesh = bem::icosphere(subdivisions, 1);
  const double grow = std::cbrt(4 * bem::kPi / 3 / bem::mass_properties(mesh, 1).volume);
  for (bem::Vec3& v : mesh.vertices) v *= grow;
  return mesh;
}

/// Shear modulus and density 1, so that frequencies are w a/c2.
inline bem::Material unit_material(double nu) {
  return material(1, 1, nu);
}

/// Displacements with the full symmetry of the icosahedron, from sums over its corners: as a block
/// of right-hand sides they find no modes but those of degree 0, 6, 10, ...
inline Eigen::MatrixXcd breathing_block(const bem::TriangleMesh& mesh) {
  constexpr int kColumns = 8;
  constexpr int kPowers[kColumns] = {0, 6, 10, 12, 16, 18, 20, 22};
  const std::vector<bem::Vec3> corners = bem::icosphere(0, 1).vertices;
  Eigen::MatrixXcd block(static_cast<Eigen::Index>(3 * mesh.vertices.size()), kColumns);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    for (int k = 0; k < kColumns; ++k) {
      const bem::Vec3 r = mesh.vertices[i].normalized();
      double sum = 0;
      for (const bem::Vec3& c : corners) sum += std::pow(c.dot(r), kPowers[k]);
      block.block<3, 1>(static_cast<Eigen::Index>(3 * i), k) = (sum * r).cast<bem::Complex>();
    }
  return block;
}

/// Around the frequencies of T2 and S2.
inline Disc low_disc() {
  return {bem::Complex(0, 2.58), 0.3};
}
/// Around the frequencies of S1, T3 and S3, for any nu >= 0.25.
inline Disc middle_disc() {
  return {bem::Complex(0, 3.75), 0.55};
}

/// Eigenvalues by the name of the family.
using FamilyValues = std::map<std::string, std::vector<bem::Complex>>;

/// Modes of a discretised sphere in a disc.
inline FamilyValues sphere_modes(const bem::TriangleMesh& mesh, double nu, const Disc& disc,
                                 const Eigen::MatrixXcd& block) {
  const SphereShapes shapes(mesh);
  FamilyValues values;
  for (const Eigenpair& p : body_modes(mesh, unit_material(nu), disc, block))
    values[shapes.family(p.vector)].push_back(p.value);
  return values;
}
inline FamilyValues low_sphere_modes(const bem::TriangleMesh& mesh, double nu) {
  const auto n = static_cast<Eigen::Index>(3 * mesh.vertices.size());
  return sphere_modes(mesh, nu, low_disc(), random_block(n, 24));
}

/// Factors z per step of the free motions of a sphere whose frequencies in space are in low_disc(),
/// from the matrices of its model.
inline FamilyValues low_factors(const bem::BodyModel& model) {
  const FreeRecursion recursion(model);
  const SphereShapes shapes(model.geometry.nodes);
  const double dt = model.discretisation.dt;
  Disc disc{amplification(recursion.scheme(), low_disc().centre * dt), 0};
  disc.radius = low_disc().radius * dt * std::abs(disc.centre);
  FamilyValues values;
  for (const Eigenpair& p : eigenpairs_in_disc([&](bem::Complex z) { return recursion(z); }, disc,
                                               random_block(recursion.size(), 32)))
    values[shapes.family(recursion.displacement(p.vector).normalized())].push_back(p.value);
  return values;
}

/// The modes of sphere_families().
inline FamilyValues all_sphere_modes(const bem::TriangleMesh& mesh, double nu) {
  const auto n = static_cast<Eigen::Index>(3 * mesh.vertices.size());
  FamilyValues values = low_sphere_modes(mesh, nu);
  values.merge(sphere_modes(mesh, nu, middle_disc(), random_block(n, 40)));
  const double breathing = sphere_families(nu).back().frequency;
  const Disc disc{bem::Complex(0, breathing), 0.05 * breathing};
  values.merge(sphere_modes(mesh, nu, disc, breathing_block(mesh)));
  return values;
}

}  // namespace bem_test
