#include "contact/block_system.hpp"

#include "algebra/lu.hpp"
#include "base/error.hpp"

#include <Eigen/SparseLU>

namespace bem {
namespace {

constexpr double kSparseFill = 0.25;  ///< share of blocks below which sparse elimination is faster
constexpr std::size_t kSparseSize = 40;    ///< contacts from which on it can be
constexpr double kPivotThreshold = 0.1;    ///< sparse: share of the largest pivot that is enough
constexpr std::size_t kDenseLimit = 2000;  ///< contacts of a dense system at most: 290 MB

bool is_sparse(std::size_t contacts, std::size_t blocks) {
  const double size = static_cast<double>(contacts);
  return contacts >= kSparseSize && static_cast<double>(blocks) < kSparseFill * size * size;
}

}  // namespace

struct BlockSystem::Sparse {
  using Matrix = Eigen::SparseMatrix<double>;
  Matrix matrix;
  Eigen::SparseLU<Matrix, Eigen::COLAMDOrdering<int>> lu;
};

BlockSystem::BlockSystem(const FrictionProblem& problem)
    : problem_(problem), position_(problem.contacts(), -1), sparse_(std::make_unique<Sparse>()) {
  sparse_->lu.setPivotThreshold(kPivotThreshold);
}

BlockSystem::~BlockSystem() = default;

bool BlockSystem::fits(const FrictionProblem& problem) {
  const std::size_t contacts = static_cast<std::size_t>(problem.contacts());
  return contacts <= kDenseLimit || is_sparse(contacts, problem.blocks.size());
}

bool BlockSystem::factorise(const std::vector<int>& active, const std::vector<Mat3>& left,
                            const std::vector<Mat3>& own) {
  if (active != active_) {
    active_ = active;
    analysed_ = false;
    std::fill(position_.begin(), position_.end(), -1);
    for (std::size_t a = 0; a < active.size(); ++a) position_[active[a]] = static_cast<int>(a);
  }
  if (active_.empty()) return true;
  std::size_t count = 0;
  for (int i : active_)
    for (int k = problem_.row_start[i]; k < problem_.row_start[i + 1]; ++k)
      count += position_[problem_.columns[k]] >= 0;
  dense_.reset();
  if (is_sparse(active_.size(), count)) return fill_sparse(left, own);
  fill_dense(left, own);
  return dense_ != nullptr;
}

void BlockSystem::fill_dense(const std::vector<Mat3>& left, const std::vector<Mat3>& own) {
  const Eigen::Index n = static_cast<Eigen::Index>(3 * active_.size());
  DenseMatrix<double> m = DenseMatrix<double>::Zero(n, n);
  for (std::size_t a = 0; a < active_.size(); ++a) {
    const int i = active_[a];
    const Eigen::Index row = static_cast<Eigen::Index>(3 * a);
    for (int k = problem_.row_start[i]; k < problem_.row_start[i + 1]; ++k) {
      const int b = position_[problem_.columns[k]];
      if (b >= 0) m.block<3, 3>(row, 3 * b).noalias() = left[i] * problem_.blocks[k];
    }
    m.block<3, 3>(row, row) += own[i];
  }
  try {
    dense_ = std::make_unique<Lu<double>>(std::move(m));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::numerical) throw;
  }
}

bool BlockSystem::fill_sparse(const std::vector<Mat3>& left, const std::vector<Mat3>& own) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t a = 0; a < active_.size(); ++a) {
    const int i = active_[a];
    for (int k = problem_.row_start[i]; k < problem_.row_start[i + 1]; ++k) {
      const int b = position_[problem_.columns[k]];
      if (b < 0) continue;
      Mat3 block = left[i] * problem_.blocks[k];
      if (problem_.columns[k] == i) block += own[i];
      for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x)
          entries.emplace_back(3 * static_cast<int>(a) + x, 3 * b + y, block(x, y));
    }
  }
  const Eigen::Index n = static_cast<Eigen::Index>(3 * active_.size());
  sparse_->matrix.resize(n, n);
  sparse_->matrix.setFromTriplets(entries.begin(), entries.end());
  if (!analysed_) {
    sparse_->lu.analyzePattern(sparse_->matrix);
    analysed_ = true;
  }
  sparse_->lu.factorize(sparse_->matrix);
  return sparse_->lu.info() == Eigen::Success;
}

void BlockSystem::solve(Eigen::VectorXd& b) const {
  if (active_.empty()) return;
  if (!dense_) {
    b = sparse_->lu.solve(b).eval();
    return;
  }
  DenseMatrix<double> column = b;
  dense_->solve(column);
  b = column;
}

}  // namespace bem
