#include "model/traction_response.hpp"

#include "compress/complex_product.hpp"

#include <list>
#include <mutex>
#include <numeric>
#include <unordered_map>

namespace bem {
namespace {

class StoredResponse : public TractionResponse {
 public:
  explicit StoredResponse(std::shared_ptr<const MatrixFamily> family)
      : family_(std::move(family)) {}

  Eigen::VectorXcd multiply(const std::vector<int>& columns,
                            const Eigen::VectorXcd& values) const override {
    return multiply_complex_sparse(*family_, columns, values);
  }
  Eigen::MatrixXcd block(const std::vector<int>& rows,
                         const std::vector<int>& columns) const override {
    return complex_block(*family_, rows, columns);
  }
  Eigen::MatrixXcd multiply_transposed(const Eigen::MatrixXcd& x) const override {
    return multiply_complex_transposed(*family_, x);
  }
  std::size_t bytes() const override { return family_->bytes(); }

 private:
  std::shared_ptr<const MatrixFamily> family_;
};

class SolvedResponse : public TractionResponse {
 public:
  SolvedResponse(std::shared_ptr<const MatrixFamily> g, const InitialSolver& solver)
      : g_(std::move(g)), solver_(solver) {}

  Eigen::VectorXcd multiply(const std::vector<int>& columns,
                            const Eigen::VectorXcd& values) const override {
    const std::lock_guard lock(mutex_);
    Eigen::VectorXcd out = Eigen::VectorXcd::Zero(static_cast<Eigen::Index>(g_->rows()));
    for_each_column(columns, [&](Eigen::Index i, const Column& column) {
      out += values[i] * column.cast<Complex>();
    });
    return out;
  }
  Eigen::MatrixXcd block(const std::vector<int>& rows,
                         const std::vector<int>& columns) const override {
    const std::lock_guard lock(mutex_);
    Eigen::MatrixXcd out(static_cast<Eigen::Index>(rows.size()),
                         static_cast<Eigen::Index>(columns.size()));
    for_each_column(columns, [&](Eigen::Index i, const Column& column) {
      out.col(i) = column(rows).cast<Complex>();
    });
    return out;
  }
  Eigen::MatrixXcd multiply_transposed(const Eigen::MatrixXcd& x) const override {
    return multiply_complex_transposed(*g_, solver_.solve_transposed(x));
  }
  std::size_t bytes() const override { return g_->bytes(); }

 private:
  using Column = Eigen::VectorXcf;
  struct Entry {
    Column column;
    std::list<int>::iterator use;
  };

  /// Calls f for every column in turn, those that are not remembered after they have been solved
  /// for together.
  template <class F>
  void for_each_column(const std::vector<int>& columns, const F& f) const {
    solve_missing(columns);
    for (std::size_t i = 0; i < columns.size(); ++i)
      f(static_cast<Eigen::Index>(i), known_.at(columns[i]).column);
  }

  void solve_missing(const std::vector<int>& columns) const {
    std::vector<int> missing;
    for (int c : columns) {
      const auto known = known_.find(c);
      if (known == known_.end())
        missing.push_back(c);
      else
        uses_.splice(uses_.begin(), uses_, known->second.use);
    }
    if (missing.empty()) return;
    std::vector<int> rows(g_->rows());
    std::iota(rows.begin(), rows.end(), 0);
    const Eigen::MatrixXcd solved = solver_.solve(complex_block(*g_, rows, missing));
    for (std::size_t i = 0; i < missing.size(); ++i) {
      uses_.push_front(missing[i]);
      known_[missing[i]] = {solved.col(static_cast<Eigen::Index>(i)).cast<std::complex<float>>(),
                            uses_.begin()};
    }
    forget(columns.size());
  }

  /// Drops those that were used least recently, but none of the last `kept`.
  void forget(std::size_t kept) const {
    constexpr std::size_t kMostBytes = std::size_t(1) << 30;
    const std::size_t most = kMostBytes / (g_->rows() * sizeof(std::complex<float>));
    while (uses_.size() > std::max(most, kept)) {
      known_.erase(uses_.back());
      uses_.pop_back();
    }
  }

  std::shared_ptr<const MatrixFamily> g_;
  const InitialSolver& solver_;
  mutable std::mutex mutex_;
  mutable std::list<int> uses_;  ///< columns, the last used first
  mutable std::unordered_map<int, Entry> known_;
};

}  // namespace

std::unique_ptr<TractionResponse> stored_response(std::shared_ptr<const MatrixFamily> response) {
  return std::make_unique<StoredResponse>(std::move(response));
}

std::unique_ptr<TractionResponse> solved_response(std::shared_ptr<const MatrixFamily> g,
                                                  const InitialSolver& solver) {
  return std::make_unique<SolvedResponse>(std::move(g), solver);
}

}  // namespace bem
