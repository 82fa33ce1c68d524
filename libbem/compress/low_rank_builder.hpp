#pragma once

#include "compress/block_factors.hpp"
#include "compress/block_partition.hpp"
#include "compress/low_rank_family.hpp"

namespace bem {

/// Compresses the matrices of a family slab by slab: of each only the rows of one slab need be
/// there at a time. Bit-identical for any number of threads.
class LowRankBuilder : public FamilyBuilder<float> {
 public:
  /// `partition`: of nodes, each of which has three unknowns, for matrices of this form. Of
  /// symmetric ones the entries below the slabs' own diagonal blocks need not be there. `quantum`:
  /// see choose_quantum().
  LowRankBuilder(std::vector<Slab> partition, int count, double quantum, MatrixForm form);

  const std::vector<Slab>& partition() const { return partition_; }
  /// The unit of coupling entries with which the Frobenius norm of the errors of the whole family
  /// comes to about `error`, by trial with some blocks of one slab: its rows of all matrices.
  /// `checked`: a last step of the trials that goes far is looked at before it is made.
  static double choose_quantum(const Slab& slab, const SlabParts<float>& parts, double error,
                               bool checked);

  /// The rows of the next slab.
  void add_rows(const std::vector<MatrixView<float>>& matrices) override {
    add_parts({matrices, nullptr, {}});
  }
  void add_parts(const SlabParts<float>& parts) override;
  std::unique_ptr<MatrixFamily> finish() override;
  double error() const override;

 private:
  struct Encoded;
  static double squared_error_of_blocks(const Slab& slab, const SlabParts<float>& parts,
                                        double quantum, std::size_t every);
  Encoded encode(const NodeBlock& block, int slab_begin, const SlabParts<float>& parts) const;
  Encoded encode_entries(const NodeBlock& block, int slab_begin,
                         const SlabParts<float>& parts) const;
  Encoded encode_factors(const FactoredBlock& block) const;
  Encoded encode_plain(const std::vector<MatrixView<float>>& entries, Encoded block) const;
  Encoded choose_form(const BlockFactors& factors, Encoded block,
                      const std::vector<MatrixView<float>>& entries) const;
  Encoded without_numbers(Encoded block) const;
  void encode_with_bases(const BlockFactors& factors, Encoded& out) const;

  std::vector<Slab> partition_;
  int count_;
  double quantum_;
  MatrixForm form_;
  std::vector<LowRankSlab> slabs_;
  double squared_error_ = 0, squared_norm_ = 0;
};

}  // namespace bem
