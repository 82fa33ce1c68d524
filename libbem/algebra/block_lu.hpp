#pragma once

#include "algebra/lu.hpp"

#include <memory>
#include <vector>

namespace bem {

/// LU factorisation of a sparse matrix of large dense blocks between groups of unknowns, such as
/// the contacts or joints between the same two bodies. Groups are eliminated in the order of least
/// degree; pivots are chosen within a group.
class BlockLu {
 public:
  /// `sizes`: unknowns per group; `coupled[i]`: groups that i acts on or that act on it.
  BlockLu(std::vector<int> sizes, const std::vector<std::vector<int>>& coupled);

  /// Zero until filled; groups must be coupled.
  DenseMatrix<double>& block(int i, int j) { return blocks_[index(i, j)]; }

  ~BlockLu();

  /// In place. False if a pivot is zero or not finite.
  bool factorise();
  /// b := M^{-1} b for any number of columns; rows: groups one after the other.
  void solve(Eigen::Ref<Eigen::MatrixXd> b) const;

  /// The factors. What restores them has been made with the same sizes and couplings.
  void visit_state(StateArchive& state);

 private:
  class Pivot;
  class SmallLu;
  int& index(int i, int j) { return index_[static_cast<std::size_t>(i) * sizes_.size() + j]; }
  int index(int i, int j) const { return index_[static_cast<std::size_t>(i) * sizes_.size() + j]; }
  void choose_order(const std::vector<std::vector<int>>& coupled);
  void add_block(int i, int j);

  std::vector<int> sizes_, begin_;       ///< by group
  std::vector<int> order_;               ///< of elimination
  std::vector<std::vector<int>> later_;  ///< by group: coupled ones that are eliminated after it
  std::vector<int> index_;               ///< of the block between two groups, or -1
  std::vector<DenseMatrix<double>> blocks_;
  std::vector<std::unique_ptr<Pivot>> pivots_;  ///< by group
};

}  // namespace bem
