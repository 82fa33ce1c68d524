#pragma once

#include "compress/block_factors.hpp"
#include "compress/block_partition.hpp"
#include "compress/low_rank_family.hpp"

namespace bem {

/// Compresses the matrices of a family slab by slab: of each only the rows of one slab need be
/// there at a time. Bit-identical for any number of threads.
class LowRankBuilder : public FamilyBuilder<float> {
 public:
  /// `partition`: of nodes, each of which has three unknowns. `quantum`: see quantum_for().
  LowRankBuilder(std::vector<Slab> partition, int count, double quantum);

  const std::vector<Slab>& partition() const { return partition_; }
  /// The unit of coupling entries with which the error of the whole family, over all its entries,
  /// comes to about `tolerance` * `norm`, with `norm` the Frobenius norm of all its matrices.
  static double quantum_for(double tolerance, double norm, std::size_t size, int count);

  /// The rows of the next slab.
  void add_rows(const std::vector<MatrixView<float>>& matrices) override;
  std::unique_ptr<MatrixFamily> finish() override;
  double error() const override;

 private:
  struct Encoded;
  Encoded encode(const NodeBlock& block, int slab_begin,
                 const std::vector<MatrixView<float>>& matrices) const;
  void encode_with_bases(const BlockFactors& factors, Encoded& out) const;

  std::vector<Slab> partition_;
  int count_;
  double quantum_;
  std::vector<LowRankSlab> slabs_;
  double squared_error_ = 0;
};

}  // namespace bem
