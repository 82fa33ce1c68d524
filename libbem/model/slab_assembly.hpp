#pragma once

#include "algebra/lu.hpp"
#include "compress/family_builder.hpp"
#include "model/body_model.hpp"

#include <functional>

namespace bem {

/// Called with the name of each phase as it begins and the fraction of it that is done.
using Progress = std::function<void(const std::string& phase, double fraction)>;

/// Rows [first, last) of nodes of all lag matrices in memory, column-major, and of the matrices of
/// lag 0. T: float or double, what is stored.
template <class T>
struct MatrixSlab {
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  int first = 0, last = 0;
  std::vector<Matrix> h, g;  ///< lags >= 1, by lag index
  /// Lag 0: real and, of complex components, imaginary parts, one component after another.
  std::vector<Eigen::MatrixXd> initial_h, initial_g;
};

/// What a slab is assembled in: single precision for far panels where storage and tolerance ask for
/// no more, double otherwise.
enum class AssemblyPrecision { single, full };

/// Assembles the matrices of a model slab by slab.
template <class T>
class SlabAssembler {
 public:
  /// Sizes the small matrices of the model (body forces), which the slabs fill. The model's
  /// geometry, discretisation and loads must be set; it must outlive this.
  SlabAssembler(BodyModel& model, AssemblyPrecision precision);

  /// Rows of nodes [first, last); uses all worker threads.
  void assemble(int first, int last, MatrixSlab<T>& slab);

  /// Frobenius norms of all matrices of a kind together, estimated from some of their rows.
  struct Norms {
    double h = 0, g = 0, initial_h = 0, initial_g = 0;
  };
  Norms estimate_norms() const;

  /// Matrices of lags >= 1, and parts of lag 0.
  int lag_count() const { return layout_.count() - layout_.initial; }
  int initial_count() const { return layout_.initial; }
  double row_sum_residual() const { return residual_; }

 private:
  bool is_loaded(int node) const { return !loaded_.empty() && loaded_[node] != 0; }
  template <class Matrix>
  void clear_columns(std::vector<Matrix>& matrices) const;
  template <class S>
  void assemble_tiles(int first, int last, MatrixSlab<T>& slab);
  template <class S>
  void distribute(int first, const std::vector<BlockRow<S>>& rows, int count,
                  MatrixSlab<T>& slab) const;
  void distribute_columns(int node, const AlignedVector<double>& from, int padded_lanes,
                          Eigen::Index first, std::vector<Eigen::MatrixXd>& lags,
                          std::vector<Eigen::MatrixXcd>& initial) const;

  BodyModel& model_;
  AssemblyPrecision precision_;
  std::vector<char> loaded_;  ///< by node: whether G has its columns; empty if there is no G
  RowAssembler assembler_;
  LaneLayout layout_;
  double residual_ = 0;
};

}  // namespace bem
