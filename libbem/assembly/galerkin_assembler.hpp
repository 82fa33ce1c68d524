#pragma once

#include "assembly/discretisation.hpp"
#include "assembly/edge_reconstruction.hpp"
#include "assembly/galerkin_combination.hpp"
#include "assembly/galerkin_rows.hpp"
#include "assembly/load_assembler.hpp"
#include "assembly/patch_block.hpp"

namespace bem {

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
  /// The wanted entries of rows, which follow one another, of symmetric matrices. Uniform strain
  /// acts where patches() have a node of a wanted column.
  void assemble(std::vector<RowColumns> wanted, GalerkinRows<double>& rows) const;
  void assemble(std::vector<RowColumns> wanted, GalerkinRows<float>& rows) const;

  /// The columns of tractions that are given on triangles: 3N x cases at every lane, put together
  /// as those of G.
  std::vector<Eigen::MatrixXd> assemble_loads(const std::vector<PanelLoad>& loads) const;

  /// M = int phi~_i L_j of all nodes [m^2], N x N: the work of nodal tractions p of an axis on
  /// displacements u of this axis is u^T M p.
  Eigen::SparseMatrix<double> work_matrix() const;

  const RadialTable& table() const { return table_; }
  const LaneTable<float>& narrow_table() const { return narrow_table_; }
  const PairIntegrals& pairs() const { return pairs_; }
  const std::vector<SurfacePatch>& patches() const { return patches_; }
  const LaneLayout& layout() const { return table_.layout(); }
  const TriangleMesh& mesh() const { return mesh_; }
  const Discretisation& discretisation() const { return discretisation_; }
  const EdgeReconstruction& reconstruction() const { return reconstruction_; }

 private:
  template <class T>
  struct LoadPart;

  std::vector<RowColumns> all_columns(int first, int last, MatrixForm form) const;
  /// `mirrored`: all rows are there, and every pair of patches is computed once.
  template <class T>
  void assemble_rows(const LaneTable<T>& lanes, bool mirrored, GalerkinRows<T>& rows) const;
  template <class T>
  void add_block_row(const SurfacePatch& y, const PatchBlock<T>& block, int row,
                     GalerkinRows<T>& rows) const;
  template <class F>
  void for_each_work(int triangle, const F& f) const;
  template <class T>
  void add_mass(const std::vector<int>& triangles, GalerkinRows<T>& rows) const;

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
  std::vector<PatchParts> parts_;  ///< of patches_
};

}  // namespace bem
