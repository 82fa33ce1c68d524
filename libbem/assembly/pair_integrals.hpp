#pragma once

#include "assembly/discretisation.hpp"
#include "assembly/pair_quadrature.hpp"
#include "assembly/pair_sums.hpp"

namespace bem {

/// Dynamic integrals over pairs of triangles of a mesh.
class PairIntegrals {
 public:
  /// The mesh must outlive this.
  PairIntegrals(const TriangleMesh& mesh, const Discretisation& discretisation);

  const PairQuadrature& quadrature() const { return quadrature_; }
  const Material& material() const { return material_; }
  const PairScales& scales() const { return scales_; }

  /// Adds those of triangles tx and ty. `batch` and `scratch` are working memory.
  template <class T>
  void add(int tx, int ty, const LaneTable<T>& lanes, PairBatch& batch, PairScratch<T>& scratch,
           const PairSums<T>& sums) const;

  /// Tractions of uniform strain on a triangle with normal n, 3 x 6, are shear_of_strain(n), and
  /// pressure_of_strain() times what pressure_kernel() stands for, where lambda kappa is finite.
  Eigen::Matrix<double, 3, 6> shear_of_strain(const Vec3& n) const;
  Vector6 pressure_of_strain() const;

 private:
  Material material_;
  PairScales scales_;
  PairQuadrature quadrature_;
};

}  // namespace bem
