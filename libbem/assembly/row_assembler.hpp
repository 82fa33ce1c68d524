#pragma once

#include "assembly/load_assembler.hpp"
#include "assembly/panel_sums.hpp"
#include "assembly/vertex_fan.hpp"
#include "kernels/radial_table.hpp"

namespace bem {

/// One block row of all lag matrices: everything that collocation vertex i contributes, lane by
/// lane (LaneLayout). Entries of 3x3 blocks are row-major; g is symmetric: xx xy xz yy yz zz.
template <class T>
struct BlockRow {
  int padded_lanes = 0;
  AlignedVector<T> h;       ///< [vertex][9][padded lane]
  AlignedVector<T> g;       ///< [vertex][6][padded lane]
  AlignedVector<double> d;  ///< [9][padded lane]
  AlignedVector<double> q;  ///< [9][padded lane]
  AlignedVector<double> c;  ///< [18][padded lane]: 3x6, columns xx xy xz yy yz zz of B

  const T* h_block(int vertex) const { return &h[std::size_t(vertex) * 9 * padded_lanes]; }
  const T* g_block(int vertex) const { return &g[std::size_t(vertex) * 6 * padded_lanes]; }
};

/// Assembles all lags of H, G, D, Q and C together in real arithmetic, one block row at a time. The
/// mesh has its origin at the centre of mass. Thread safe: rows may be assembled in parallel, each
/// thread with its own Workspace. Cost per row: O(N) panels of 6 to 33 points.
class RowAssembler {
 public:
  struct Workspace {
    PointBatch batch;
    PanelScratch<double> scratch;
    PanelScratch<float> far_scratch;
    AlignedVector<double> sums;
    AlignedVector<float> far_sums;
  };

  /// `extent`: largest distance between two vertices (mesh/extent.hpp) [m].
  RowAssembler(const TriangleMesh& mesh, double extent, const Discretisation& discretisation);

  /// Row of collocation vertex `vertex`; with `fix_translation` its own block is set so that rigid
  /// translation is exact for every lag (M43), whatever the quadrature. Returns the largest entry
  /// of that change (the free term is about 1/2): the row-sum residual of the quadrature. In single
  /// precision far panels are computed in single precision, near and singular ones in double: about
  /// 1e-7 of the static kernels, at half the cost.
  double assemble(int vertex, bool fix_translation, Workspace& workspace,
                  BlockRow<double>& row) const;
  double assemble(int vertex, bool fix_translation, Workspace& workspace,
                  BlockRow<float>& row) const;

  /// Row of the load columns sum_T int u* dGamma p_T at every lane: out[lane] is 3 x cases. The
  /// tractions are exact, with jumps from triangle to triangle.
  std::vector<Eigen::Matrix3Xd> assemble_loads(int vertex, const std::vector<PanelLoad>& loads,
                                               Workspace& workspace) const;

  const RadialTable& table() const { return table_; }
  const LaneLayout& layout() const { return table_.layout(); }
  const TriangleMesh& mesh() const { return mesh_; }
  const Discretisation& discretisation() const { return discretisation_; }

 private:
  template <class T>
  double assemble_row(int vertex, bool fix_translation, Workspace& workspace, BlockRow<T>& row,
                      const LaneTable<T>& lanes) const;
  void sum_panel(int vertex, int triangle, Workspace& work, AlignedVector<double>& sums) const;
  void sum_panel(int vertex, int triangle, Workspace& work, AlignedVector<float>& sums) const;
  template <class T>
  double fix_own_block(int vertex, BlockRow<T>& row) const;

  const TriangleMesh& mesh_;
  Discretisation discretisation_;
  RadialTable table_;
  LaneTable<float> far_table_;
  KernelScales scales_;
  PanelQuadrature quadrature_;
  VertexFans fans_;
};

}  // namespace bem
