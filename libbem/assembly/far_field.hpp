#pragma once

#include "assembly/far_block.hpp"
#include "assembly/galerkin_combination.hpp"
#include "assembly/pair_integrals.hpp"
#include "assembly/surface_points.hpp"

namespace bem {

/// What is to be found between two clusters.
struct FarTask {
  NodeRange rows, columns;
  bool with_h = true;                         ///< else G alone
  const std::vector<char>* loaded = nullptr;  ///< by node: whether G has its columns; empty: no G
  std::vector<const SurfacePatch*> strained;  ///< where uniform strain acts on the rows
};

/// Galerkin matrices between distant clusters of nodes in factors, without their entries. Both
/// surfaces are integrated by the midpoints of edges. A sample of points y tells which rows, one
/// component of the test function at one point x, all others are combinations of (RowSkeleton);
/// these rows are then computed for all y, and further points y measure the error. It is an
/// adaptive cross approximation (Bebendorf 2000) of all lags and components together.
class FarField {
 public:
  /// All must outlive this.
  FarField(const TriangleMesh& mesh, const EdgeReconstruction& reconstruction,
           const PairIntegrals& pairs, const GalerkinCombination& combination,
           const LaneLayout& layout);

  /// Whether midpoints of edges suffice between two clusters.
  bool holds(const NodeRange& rows, const NodeRange& columns) const;

  /// `lanes`: of hypersingular_family(). Pure.
  template <class T>
  FarBlock factor(const FarTask& task, const FarErrors& errors, const LaneTable<T>& lanes) const;

 private:
  template <class T>
  class DynamicFactors;

  FactoredMatrices stiffness(const FarTask& task, double error) const;

  const TriangleMesh& mesh_;
  const PairIntegrals& pairs_;
  const GalerkinCombination& combination_;
  LaneLayout layout_;
  double radius_ = 0;  ///< of the body about its centre of mass [m]
  SurfacePoints surface_;
  /// Lanes of lag 0 of H, and of G, by those of Z and J, and of G by the static part.
  Eigen::MatrixXd initial_of_inertia_, g_of_adjoint_;
  Eigen::VectorXd g_of_static_;
};

/// Points of a cluster in an order of which every beginning is a fair sample: alternately the one
/// that is closest to the box, and one of an even spread.
std::vector<int> sampling_order(const SurfacePoints& surface, const NodeRange& nodes,
                                const BoundingBox& seen_from);

}  // namespace bem
