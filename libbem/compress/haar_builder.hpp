#pragma once

#include "compress/family_builder.hpp"
#include "compress/haar_family.hpp"
#include "compress/haar_selection.hpp"

namespace bem {

/// Makes a HaarFamily from slabs of rows: the ranges of nodes of slabs().
///
/// Columns are transformed, and rows within a slab, as slabs come; means over the rows of slabs,
/// one row per slab, wait for finish(), so that the transform is that of the whole matrices. Of the
/// other coefficients those are kept in packed form that may still be among the largest. Memory:
/// the means (a part 1/kSlabNodes to 2/kSlabNodes of the matrices in single precision), two to
/// three times what the family takes with values in single precision, and what a slab is
/// transformed in.
class HaarBuilder : public FamilyBuilder<float> {
 public:
  static constexpr int kSlabNodes = 64;  ///< a slab has at most so many

  /// Matrices of `nodes` nodes in the order of recursive bisection, with three unknowns each.
  HaarBuilder(int nodes, int count, const CodecOptions& options);

  /// First nodes of the slabs, and the number of nodes.
  static std::vector<int> slabs(int nodes) { return haar_ranges(nodes, kSlabNodes); }

  void add_rows(const std::vector<MatrixView<float>>& matrices) override;
  std::unique_ptr<MatrixFamily> finish() override;
  /// Known after finish().
  double error() const override { return error_; }

 private:
  using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// Large coefficients of some rows of C, which are numbered through all matrices.
  struct Part {
    std::vector<std::size_t> numbers;
    PackedRows rows;

    template <class F>
    void filter(F&& keeps);
  };
  class Collector;
  class Choice;

  Part transform_slab(const MatrixView<float>& matrix, int index, int axis,
                      MagnitudeHistogram& histogram);
  Part transform_means(int index, int axis, MagnitudeHistogram& histogram);
  template <class F>
  void collect(std::size_t coefficients_per_task, const F& transform);
  void drop_small();
  double squares_of_parts() const;
  double pack_parts(PackedRows& to) const;

  int nodes_, count_;
  CodecOptions options_;
  std::vector<int> slab_begins_;
  std::vector<HaarStep> column_steps_, slab_steps_;  ///< of nodes; of slabs
  HaarSelection selection_;
  std::size_t slab_ = 0;
  std::vector<RowMajor> means_;  ///< [3 * matrix + axis]: slabs x columns
  std::vector<Part> parts_;
  std::size_t entries_ = 0, entries_after_drop_ = 0;  ///< of the parts
  double error_ = 0;
};

}  // namespace bem
