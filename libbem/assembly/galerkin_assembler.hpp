#pragma once

#include "algebra/matrix_form.hpp"
#include "assembly/discretisation.hpp"
#include "assembly/edge_reconstruction.hpp"
#include "assembly/galerkin_combination.hpp"
#include "assembly/load_assembler.hpp"
#include "assembly/patch_block.hpp"

namespace bem {

/// Rows of nodes [first, last) of all Galerkin matrices before they are put together: the static
/// parts, and lane by lane (LaneLayout) the dynamic ones, of which the matrices are
///   H = D(0) + (s dt)^2 Z/dt^2,   G = M/2 - K'(0) - (s dt)^2 J/(c2 dt)^2
/// (kernels/lag_product.hpp), with D(0) and M/2 - K'(0) in the real lanes of lag 0 (a damped
/// material: those of 1/m in G). Z and D(0) are symmetric.
template <class T>
struct GalerkinRows {
  int first = 0, last = 0, nodes = 0, padded_lanes = 0;
  /// All of Z and D(0), or, of the row of node i, the columns of nodes from i on; the others are
  /// not meant to be looked at.
  MatrixForm form = MatrixForm::general;
  int first_column = 0;          ///< node: columns of Z before it are not stored
  AlignedVector<T> inertia;      ///< Z: [row][node from first_column on][3x3 entry][padded lane]
  AlignedVector<T> adjoint;      ///< J: [row][node][3x3 entry][padded lane]
  AlignedVector<double> strain;  ///< J of uniform strain: [row][3 axes x 6][padded lane]
  Eigen::MatrixXd static_h, static_g;  ///< D(0), M/2 - K'(0): 3 (last - first) x 3N

  T* inertia_block(int row, int node) {
    return &inertia[(std::size_t(row) * (nodes - first_column) + node - first_column) * 9 *
                    padded_lanes];
  }
  const T* inertia_block(int row, int node) const {
    return &inertia[(std::size_t(row) * (nodes - first_column) + node - first_column) * 9 *
                    padded_lanes];
  }
  const T* adjoint_block(int row, int node) const {
    return &adjoint[(std::size_t(row) * nodes + node) * 9 * padded_lanes];
  }
};

/// Assembles the Galerkin matrices of all lags together in real arithmetic, some rows at a time.
/// The mesh has its origin at the centre of mass.
class GalerkinAssembler {
 public:
  /// `extent`: largest distance between two vertices (mesh/extent.hpp) [m].
  GalerkinAssembler(const TriangleMesh& mesh, double extent, const Discretisation& discretisation);
  ~GalerkinAssembler();

  /// Rows of nodes [first, last) with the entries that matrices of this form store; uses all worker
  /// threads, and gives the same for any number.
  void assemble(int first, int last, MatrixForm form, GalerkinRows<double>& rows) const;
  void assemble(int first, int last, MatrixForm form, GalerkinRows<float>& rows) const;

  /// The columns of tractions that are given on triangles: 3N x cases at every lane, put together
  /// as those of G.
  std::vector<Eigen::MatrixXd> assemble_loads(const std::vector<PanelLoad>& loads) const;

  /// M = int phi~_i L_j of all nodes [m^2], N x N: the work of nodal tractions p of an axis on
  /// displacements u of this axis is u^T M p.
  Eigen::SparseMatrix<double> work_matrix() const;

  const RadialTable& table() const { return table_; }
  const LaneLayout& layout() const { return table_.layout(); }
  const TriangleMesh& mesh() const { return mesh_; }
  const Discretisation& discretisation() const { return discretisation_; }
  const EdgeReconstruction& reconstruction() const { return reconstruction_; }

 private:
  template <class T>
  struct LoadPart;

  template <class T>
  void assemble_rows(int first, int last, MatrixForm form, const LaneTable<T>& lanes,
                     GalerkinRows<T>& rows) const;
  template <class T>
  void add_block_row(const SurfacePatch& y, const PatchBlock<T>& block, int row,
                     GalerkinRows<T>& rows) const;
  template <class F>
  void for_each_work(int triangle, const F& f) const;
  void add_mass(const std::vector<int>& triangles, int first, int last, Eigen::MatrixXd& g) const;

  template <class T>
  void sum_loads(int tx, const std::vector<PanelLoad>& loads, const LaneTable<T>& lanes,
                 LoadPart<T>& part) const;
  template <class T>
  std::vector<Eigen::MatrixXd> assemble_loads(const std::vector<PanelLoad>& loads,
                                              const LaneTable<T>& lanes) const;

  const TriangleMesh& mesh_;
  Discretisation discretisation_;
  RadialTable table_;
  LaneTable<float> narrow_table_;
  PairIntegrals pairs_;
  EdgeReconstruction reconstruction_;
  std::vector<TriangleBasis> bases_;
  std::vector<SurfacePatch> patches_;
};

}  // namespace bem
