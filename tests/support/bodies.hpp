#pragma once

#include "base/material.hpp"
#include "mesh/extent.hpp"
#include "mesh/mass_properties.hpp"
#include "mesh/shapes.hpp"

namespace bem_test {

/// The mesh moved so that its centre of mass is the origin.
inline bem::TriangleMesh centred(bem::TriangleMesh mesh) {
  const bem::Vec3 centre = bem::mass_properties(mesh, 1).centre;
  for (bem::Vec3& v : mesh.vertices) v -= centre;
  return mesh;
}

inline bem::Material material(double density, double shear_modulus, double poisson_ratio) {
  bem::Material m;
  m.name = "test";
  m.density = density;
  m.shear_modulus = shear_modulus;
  m.poisson_ratio = poisson_ratio;
  return m;
}

/// Translations (3N x 3) and rotations W w = w x x (3N x 3) of the vertices.
inline Eigen::MatrixXd translations(const bem::TriangleMesh& mesh) {
  Eigen::MatrixXd t(3 * mesh.vertices.size(), 3);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    t.middleRows<3>(3 * i) = bem::Mat3::Identity();
  return t;
}
inline Eigen::MatrixXd rotations(const bem::TriangleMesh& mesh) {
  Eigen::MatrixXd w(3 * mesh.vertices.size(), 3);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    w.middleRows<3>(3 * i) = bem::cross_matrix(mesh.vertices[i]).transpose();
  return w;
}

}  // namespace bem_test
