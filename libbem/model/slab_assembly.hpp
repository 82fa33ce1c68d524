#pragma once

#include "algebra/lu.hpp"
#include "algebra/matrix_form.hpp"
#include "assembly/far_block.hpp"
#include "assembly/galerkin_rows.hpp"
#include "compress/family_builder.hpp"
#include "model/body_model.hpp"

#include <functional>

namespace bem {

/// Called with the name of each phase as it begins and the fraction of it that is done.
using Progress = std::function<void(const std::string& phase, double fraction)>;

/// Rows [first, last) of nodes of all lag matrices in memory, column-major, and of the matrices of
/// lag 0. T: float or double, what is stored. Symmetric matrices may lack what is to the left of
/// the slab's own columns. Columns that are in `far` are not stored otherwise.
template <class T>
struct MatrixSlab {
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  int first = 0, last = 0;
  ColumnPlaces h_columns, g_columns;  ///< of the stored columns of all matrices of H and of G
  std::vector<FarBlock> far;
  std::vector<Matrix> h, g;   ///< lags >= 1, by lag index
  Eigen::MatrixXd stiffness;  ///< D(0) of the inertial form, which is part of initial_h
  /// Lag 0: real and, of complex components, imaginary parts, one component after another.
  std::vector<Eigen::MatrixXd> initial_h, initial_g;
};

/// What a slab is assembled in: single precision for far panels where storage and tolerance ask for
/// no more, double otherwise.
enum class AssemblyPrecision { single, full };

/// Assembles the matrices of a model slab by slab, by one discretisation in space.
template <class T>
class SlabAssembler {
 public:
  virtual ~SlabAssembler() = default;

  /// Rows of nodes [first, last); uses all worker threads. Fills the rows of the model's small
  /// matrices (body forces), too.
  virtual void assemble(int first, int last, MatrixSlab<T>& slab) = 0;

  /// Frobenius norms of all matrices of a kind together, estimated from some of their rows.
  struct Norms {
    double h = 0, g = 0, stiffness = 0, initial_h = 0, initial_g = 0;
    double initial_inertia = 0;  ///< initial_h without the stiffness
    /// Of sums of squares, times `scale`.
    Norms root(double scale) const;
  };
  virtual Norms estimate_norms() = 0;

  /// Lets slabs with the rows of one of these have their distant blocks in factors, where that is
  /// worth it: then allow_errors() follows before the first slab. To be called first.
  virtual void use_factors(const std::vector<Slab>& /*partition*/) {}
  virtual void allow_errors(const FarErrors& /*errors*/) {}

  virtual double row_sum_residual() const = 0;
  /// Whether lags of h multiply accelerations, and slabs have `stiffness`.
  virtual bool is_inertial() const = 0;
  /// Of h, initial_h and the stiffness.
  virtual MatrixForm form() const = 0;

  /// Matrices of lags >= 1, and parts of lag 0.
  int lag_count() const { return layout_.count() - layout_.initial; }
  int initial_count() const { return layout_.initial; }

 protected:
  /// Sizes the small matrices of the model.
  explicit SlabAssembler(BodyModel& model);

  bool has_tractions() const { return !loaded_.empty(); }
  bool is_loaded(int node) const { return has_tractions() && loaded_[node] != 0; }
  /// By node; empty if there is no G.
  const std::vector<char>& loaded_nodes() const { return loaded_; }
  /// Sizes a slab with these columns; those of G without loads are zero.
  void prepare(int first, int last, ColumnPlaces h, ColumnPlaces g, MatrixSlab<T>& slab) const;
  /// A slab with all columns.
  void prepare(int first, int last, MatrixSlab<T>& slab) const;
  /// Lanes of 3 x n numbers of a node, row after row, to columns from `first` on.
  void distribute_columns(int node, const double* from, int entries, int padded_lanes,
                          Eigen::Index first, std::vector<Eigen::MatrixXd>& lags,
                          std::vector<Eigen::MatrixXcd>& initial) const;
  /// Adds lanes of 3 x 6 numbers of a node to such matrices.
  void add_columns(int node, const double* from, int padded_lanes,
                   std::vector<Eigen::MatrixXd>& lags,
                   std::vector<Eigen::MatrixXcd>& initial) const;

  BodyModel& model_;
  LaneLayout layout_;

 private:
  /// f(entry, value) for every number that such lanes stand for.
  template <class F>
  void change_columns(int node, const double* from, int entries, int padded_lanes,
                      Eigen::Index first, std::vector<Eigen::MatrixXd>& lags,
                      std::vector<Eigen::MatrixXcd>& initial, const F& f) const;
  template <class Matrix>
  void clear_columns(const ColumnPlaces& columns, std::vector<Matrix>& matrices) const;

  std::vector<char> loaded_;  ///< by node: whether G has its columns; empty if there is no G
};

/// By the model's discretisation. Its geometry, discretisation and loads must be set; it must
/// outlive the assembler. `whole`: symmetric matrices, too, are wanted with all their entries.
template <class T>
std::unique_ptr<SlabAssembler<T>> make_slab_assembler(BodyModel& model, AssemblyPrecision precision,
                                                      bool whole);

}  // namespace bem
