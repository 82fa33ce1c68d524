#include "model/initial_solver.hpp"

#include "algebra/gmres.hpp"
#include "algebra/lu.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "compress/complex_product.hpp"
#include "mesh/bisection.hpp"

#include <algorithm>
#include <numeric>

#include <Eigen/LU>

namespace bem {
namespace {

class DirectSolver : public InitialSolver {
 public:
  explicit DirectSolver(const MatrixFamily& inverse) : inverse_(inverse) {}

  Eigen::MatrixXcd solve(const Eigen::MatrixXcd& b, const Eigen::MatrixXcd&) const override {
    return multiply_complex(inverse_, b);
  }
  Eigen::MatrixXcd solve_transposed(const Eigen::MatrixXcd& b) const override {
    return multiply_complex_transposed(inverse_, b);
  }
  Preconditioned precondition_transposed(const Eigen::MatrixXcd& b) const override {
    return {solve_transposed(b), b};
  }
  std::size_t bytes() const override { return inverse_.bytes(); }
  bool is_iterative() const override { return false; }

 private:
  const MatrixFamily& inverse_;
};

/// The inverses of diagonal blocks, in the precision of Scalar, which is complex.
template <class Scalar>
class BlockDiagonal {
 public:
  BlockDiagonal(const MatrixFamily& h, int nodes) {
    divide(0, nodes);
    inverses_.resize(ranges_.size());
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
      std::vector<int> indices(3 * static_cast<std::size_t>(ranges_[i].size()));
      std::iota(indices.begin(), indices.end(), 3 * ranges_[i].begin);
      const Eigen::MatrixXcd block = complex_block(h, indices, indices);
      inverses_[i] = block.partialPivLu().inverse().template cast<Scalar>();
      require(inverses_[i].allFinite(), "the diagonal blocks of H_0 can be inverted");
    }
  }

  Eigen::MatrixXcd apply(const Eigen::MatrixXcd& b, bool transposed) const {
    Eigen::MatrixXcd out(b.rows(), b.cols());
    parallel_for(ranges_.size(), [&](std::size_t i) {
      const DenseMatrix<Scalar>& inverse = inverses_[i];
      const auto from = b.middleRows(3 * ranges_[i].begin, inverse.rows());
      for (Eigen::Index c = 0; c < b.cols(); ++c) {  // each column on its own: same bits always
        const Eigen::Matrix<Scalar, Eigen::Dynamic, 1> x = from.col(c).template cast<Scalar>();
        Eigen::Matrix<Scalar, Eigen::Dynamic, 1> y(x.size());
        if (transposed)
          y.noalias() = inverse.transpose() * x;
        else
          y.noalias() = inverse * x;
        out.col(c).segment(3 * ranges_[i].begin, y.size()) = y.template cast<Complex>();
      }
    });
    return out;
  }

 private:
  struct Range {
    int begin, end;
    int size() const { return end - begin; }
  };
  /// The clusters of the recursive bisection that ordered the nodes.
  void divide(int begin, int end) {
    constexpr int kMostNodes = 96;
    if (end - begin <= kMostNodes) {
      ranges_.push_back({begin, end});
      return;
    }
    const int middle = begin + first_half(end - begin);
    divide(begin, middle);
    divide(middle, end);
  }

  std::vector<Range> ranges_;
  std::vector<DenseMatrix<Scalar>> inverses_;
};

template <class Scalar>
class IterativeSolver : public InitialSolver {
 public:
  IterativeSolver(const MatrixFamily& h, int nodes, double tolerance)
      : h_(h), preconditioner_(h, nodes), tolerance_(tolerance) {}

  Eigen::MatrixXcd solve(const Eigen::MatrixXcd& b, const Eigen::MatrixXcd& guess) const override {
    const Operator h = [this](const Eigen::MatrixXcd& x) { return multiply_complex(h_, x); };
    return iterate(h, false, b, guess);
  }
  Eigen::MatrixXcd solve_transposed(const Eigen::MatrixXcd& b) const override {
    const Operator h = [this](const Eigen::MatrixXcd& x) {
      return multiply_complex_transposed(h_, x);
    };
    return iterate(h, true, b, {});
  }
  Preconditioned precondition_transposed(const Eigen::MatrixXcd& b) const override {
    Preconditioned out;
    out.solution = preconditioner_.apply(b, true);
    out.product = multiply_complex_transposed(h_, out.solution);
    return out;
  }

  std::size_t bytes() const override { return h_.bytes(); }
  bool is_iterative() const override { return true; }

 private:
  using Operator = ColumnOperator<Complex>;

  /// Some columns at a time, so that their Krylov spaces fit the memory.
  Eigen::MatrixXcd iterate(const Operator& h, bool transposed, const Eigen::MatrixXcd& b,
                           const Eigen::MatrixXcd& guess) const {
    constexpr Eigen::Index kTogether = 24;
    constexpr double kAcceptable = 100;  // tolerances
    const Operator precondition = [&](const Eigen::MatrixXcd& x) {
      return preconditioner_.apply(x, transposed);
    };
    Eigen::MatrixXcd u = guess.size() > 0 ? guess : Eigen::MatrixXcd::Zero(b.rows(), b.cols());
    for (Eigen::Index first = 0; first < b.cols(); first += kTogether) {
      const Eigen::Index count = std::min(kTogether, b.cols() - first);
      Eigen::MatrixXcd x = u.middleCols(first, count);
      const GmresResult result =
          gmres<Complex>(h, b.middleCols(first, count), x, {tolerance_, 300}, precondition);
      if (!(result.residual <= kAcceptable * tolerance_))
        throw Error(ErrorCode::numerical,
                    "the equations of a step cannot be solved iteratively; make the archive with "
                    "--inverse dense");
      u.middleCols(first, count) = x;
    }
    return u;
  }

  const MatrixFamily& h_;
  BlockDiagonal<Scalar> preconditioner_;
  double tolerance_;
};

}  // namespace

std::unique_ptr<InitialSolver> make_initial_solver(const BodyModel& model, int component) {
  if (!model.inverse.empty()) return std::make_unique<DirectSolver>(*model.inverse[component]);
  const MatrixFamily& h = *model.initial_h[component];
  const int nodes = static_cast<int>(model.nodes());
  // to what the matrices know, and a little more
  if (model.codec == Codec::none && model.precision == Precision::float64)
    return std::make_unique<IterativeSolver<Complex>>(h, nodes, 1e-13);
  return std::make_unique<IterativeSolver<std::complex<float>>>(
      h, nodes, model.codec == Codec::none ? 1e-7 : 1e-6);
}

}  // namespace bem
