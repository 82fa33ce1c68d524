#include "algebra/block_lu.hpp"

#include "algebra/blas.hpp"
#include "base/error.hpp"
#include "base/interruption.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>

#include <Eigen/LU>

namespace bem {
namespace {

/// Below these sizes simple loops are faster than the libraries for large matrices.
constexpr int kSmallPivot = 100;
constexpr double kSmallProduct = 40'000;  // multiplications

void subtract_product(const DenseMatrix<double>& a, const DenseMatrix<double>& b,
                      DenseMatrix<double>& c) {
  const int m = static_cast<int>(c.rows()), n = static_cast<int>(c.cols()),
            k = static_cast<int>(a.cols());
  if (static_cast<double>(m) * n * k < kSmallProduct)
    c.noalias() -= a * b;
  else
    gemm(m, n, k, -1.0, a.data(), m, b.data(), k, c.data(), m);
}

}  // namespace

/// A small LU factorisation with a state.
class BlockLu::SmallLu : public Eigen::PartialPivLU<DenseMatrix<double>> {
 public:
  void visit_state(StateArchive& state) {
    state.resizable(m_lu, m_p.indices());
    const Eigen::Index n = m_lu.rows();
    state.check(m_lu.cols() == n && m_p.size() == n);
    std::vector<char> seen(static_cast<std::size_t>(n), 0);
    for (Eigen::Index k = 0; k < m_p.size(); ++k) {
      const int row = m_p.indices()[k];
      state.check(row >= 0 && row < n && !seen[row]);
      seen[row] = 1;
    }
    m_isInitialized = true;
  }
};

/// Factors of a block of the diagonal.
class BlockLu::Pivot {
 public:
  Pivot() = default;  ///< of nothing, to be restored
  explicit Pivot(DenseMatrix<double>&& a) {
    if (a.rows() < kSmallPivot) {
      small_.compute(a);
      const auto pivots = small_.matrixLU().diagonal().array();
      if (!pivots.isFinite().all() || (pivots == 0).any())
        throw Error(ErrorCode::numerical, "a pivot is zero or not finite");
    } else {
      large_.emplace(std::move(a));
    }
  }

  void solve(DenseMatrix<double>& b) const {
    if (large_)
      large_->solve(b);
    else if (b.rows() > 0)
      b = small_.solve(b).eval();
  }

  /// `size`: unknowns of the group.
  void visit_state(StateArchive& state, int size) {
    if (state.restores() && size >= kSmallPivot) large_.emplace();
    if (large_)
      state(*large_);
    else
      state(small_);
    state.check((large_ ? large_->size() : small_.matrixLU().rows()) == size);
  }

 private:
  SmallLu small_;
  std::optional<Lu<double>> large_;
};

BlockLu::~BlockLu() = default;

BlockLu::BlockLu(std::vector<int> sizes, const std::vector<std::vector<int>>& coupled)
    : sizes_(std::move(sizes)),
      begin_(sizes_.size() + 1, 0),
      later_(sizes_.size()),
      index_(sizes_.size() * sizes_.size(), -1),
      pivots_(sizes_.size()) {
  std::partial_sum(sizes_.begin(), sizes_.end(), begin_.begin() + 1);
  const int count = static_cast<int>(sizes_.size());
  for (int i = 0; i < count; ++i) {
    add_block(i, i);
    for (int j : coupled[i]) {
      add_block(i, j);
      add_block(j, i);
    }
  }
  choose_order(coupled);
}

void BlockLu::add_block(int i, int j) {
  if (index(i, j) >= 0) return;
  index(i, j) = static_cast<int>(blocks_.size());
  blocks_.emplace_back(DenseMatrix<double>::Zero(sizes_[i], sizes_[j]));
}

/// Eliminates the group with the fewest unknowns around it, again and again; adds the blocks that
/// fill in.
void BlockLu::choose_order(const std::vector<std::vector<int>>& coupled) {
  const int count = static_cast<int>(sizes_.size());
  std::vector<std::set<int>> around(count);
  for (int i = 0; i < count; ++i)
    for (int j : coupled[i])
      if (i != j) {
        around[i].insert(j);
        around[j].insert(i);
      }
  const auto degree = [&](int i) {
    int sum = 0;
    for (int j : around[i]) sum += sizes_[j];
    return sum;
  };
  std::set<std::pair<int, int>> queue;  // (degree, group)
  std::vector<int> degrees(count);
  for (int i = 0; i < count; ++i) queue.insert({degrees[i] = degree(i), i});
  while (!queue.empty()) {
    const int k = queue.begin()->second;
    queue.erase(queue.begin());
    order_.push_back(k);
    later_[k].assign(around[k].begin(), around[k].end());
    for (int i : later_[k]) {
      around[i].erase(k);
      for (int j : later_[k])
        if (j != i) {
          around[i].insert(j);
          add_block(i, j);
        }
    }
    for (int i : later_[k]) {
      queue.erase({degrees[i], i});
      queue.insert({degrees[i] = degree(i), i});
    }
  }
}

bool BlockLu::factorise() {
  for (int k : order_) {
    check_interruption();
    try {
      pivots_[k] = std::make_unique<Pivot>(std::move(block(k, k)));
    } catch (const Error& error) {
      if (error.code() != ErrorCode::numerical) throw;
      return false;
    }
    for (int j : later_[k]) pivots_[k]->solve(block(k, j));
    for (int i : later_[k])
      for (int j : later_[k]) subtract_product(block(i, k), block(k, j), block(i, j));
  }
  return true;
}

void BlockLu::solve(Eigen::Ref<Eigen::MatrixXd> b) const {
  for (int k : order_) {
    DenseMatrix<double> part = b.middleRows(begin_[k], sizes_[k]);
    pivots_[k]->solve(part);
    b.middleRows(begin_[k], sizes_[k]) = part;
    for (int i : later_[k])
      b.middleRows(begin_[i], sizes_[i]).noalias() -= blocks_[index(i, k)] * part;
  }
  for (auto k = order_.rbegin(); k != order_.rend(); ++k)
    for (int j : later_[*k])
      b.middleRows(begin_[*k], sizes_[*k]).noalias() -=
          blocks_[index(*k, j)] * b.middleRows(begin_[j], sizes_[j]);
}

void BlockLu::visit_state(StateArchive& state) {
  for (int k : order_) {
    if (state.restores()) pivots_[k] = std::make_unique<Pivot>();
    pivots_[k]->visit_state(state, sizes_[k]);
    for (int other : later_[k]) state(block(k, other), block(other, k));
  }
}

}  // namespace bem
