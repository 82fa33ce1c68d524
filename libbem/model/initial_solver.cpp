#include "model/initial_solver.hpp"

#include "algebra/decompositions.hpp"
#include "algebra/gmres.hpp"
#include "algebra/lu.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "compress/complex_product.hpp"
#include "mesh/bisection.hpp"

#include <algorithm>
#include <numeric>

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

/// What vectors are solved for: those of a real matrix as real and imaginary parts, side by side.
template <class T>
struct Working;
template <>
struct Working<double> {
  static Eigen::MatrixXd from(const Eigen::MatrixXcd& v) { return parts_of(v); }
  static Eigen::MatrixXcd back(const Eigen::MatrixXd& v) { return from_parts(v); }
  static Eigen::MatrixXd multiply(const MatrixFamily& h, const Eigen::MatrixXd& v,
                                  bool transposed) {
    return transposed ? multiply_real_transposed(h, v) : multiply_real(h, v);
  }
  static Eigen::MatrixXd block(const MatrixFamily& h, const std::vector<int>& indices) {
    return h.block(0, indices, indices);
  }
};
template <>
struct Working<Complex> {
  static const Eigen::MatrixXcd& from(const Eigen::MatrixXcd& v) { return v; }
  static const Eigen::MatrixXcd& back(const Eigen::MatrixXcd& v) { return v; }
  static Eigen::MatrixXcd multiply(const MatrixFamily& h, const Eigen::MatrixXcd& v,
                                   bool transposed) {
    return transposed ? multiply_complex_transposed(h, v) : multiply_complex(h, v);
  }
  static Eigen::MatrixXcd block(const MatrixFamily& h, const std::vector<int>& indices) {
    return complex_block(h, indices, indices);
  }
};

/// The inverses of diagonal blocks, kept as numbers of type Stored, for vectors of T.
template <class T, class Stored>
class BlockDiagonal {
 public:
  BlockDiagonal(const MatrixFamily& h, int nodes) {
    divide(0, nodes);
    inverses_.resize(ranges_.size());
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
      std::vector<int> indices(3 * static_cast<std::size_t>(ranges_[i].size()));
      std::iota(indices.begin(), indices.end(), 3 * ranges_[i].begin);
      const DenseMatrix<T> block = Working<T>::block(h, indices);
      inverses_[i] = bem::inverse(block).template cast<Stored>();
      if (!inverses_[i].allFinite())
        throw Error(ErrorCode::numerical,
                    "the diagonal blocks of H_0 cannot be inverted: the matrices are of no body, "
                    "make the archive again with bemprecomp");
    }
  }

  ColumnsOf<T> apply(const ColumnsOf<T>& b, bool transposed) const {
    using Vector = Eigen::Matrix<Stored, Eigen::Dynamic, 1>;
    ColumnsOf<T> out(b.rows(), b.cols());
    parallel_for(ranges_.size(), [&](std::size_t i) {
      const DenseMatrix<Stored>& inverse = inverses_[i];
      const Eigen::Index first = 3 * ranges_[i].begin;
      for (Eigen::Index c = 0; c < b.cols(); ++c) {  // each column on its own: same bits always
        const Vector x = b.col(c).segment(first, inverse.rows()).template cast<Stored>();
        Vector y(x.size());
        if (transposed)
          y.noalias() = inverse.transpose() * x;
        else
          y.noalias() = inverse * x;
        out.col(c).segment(first, y.size()) = y.template cast<T>();
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
  std::vector<DenseMatrix<Stored>> inverses_;
};

/// T: double or Complex, as H_0 is.
template <class T, class Stored>
class IterativeSolver : public InitialSolver {
 public:
  IterativeSolver(const MatrixFamily& h, int nodes, double tolerance)
      : h_(h), preconditioner_(h, nodes), tolerance_(tolerance) {}

  Eigen::MatrixXcd solve(const Eigen::MatrixXcd& b, const Eigen::MatrixXcd& guess) const override {
    return Working<T>::back(iterate(Working<T>::from(b), Working<T>::from(guess), false));
  }
  Eigen::MatrixXcd solve_transposed(const Eigen::MatrixXcd& b) const override {
    return Working<T>::back(iterate(Working<T>::from(b), ColumnsOf<T>(), true));
  }
  Preconditioned precondition_transposed(const Eigen::MatrixXcd& b) const override {
    const ColumnsOf<T> solution = preconditioner_.apply(Working<T>::from(b), true);
    return {Working<T>::back(solution), Working<T>::back(Working<T>::multiply(h_, solution, true))};
  }

  std::size_t bytes() const override { return h_.bytes(); }
  bool is_iterative() const override { return true; }

 private:
  /// Some columns at a time, so that their Krylov spaces fit the memory.
  ColumnsOf<T> iterate(const ColumnsOf<T>& b, const ColumnsOf<T>& guess, bool transposed) const {
    constexpr Eigen::Index kTogether = 24;
    constexpr double kAcceptable = 100;  // tolerances
    const ColumnOperator<T> multiply = [&](const ColumnsOf<T>& x) {
      return Working<T>::multiply(h_, x, transposed);
    };
    const ColumnOperator<T> precondition = [&](const ColumnsOf<T>& x) {
      return preconditioner_.apply(x, transposed);
    };
    ColumnsOf<T> u = guess.size() > 0 ? guess : ColumnsOf<T>::Zero(b.rows(), b.cols());
    for (Eigen::Index first = 0; first < b.cols(); first += kTogether) {
      const Eigen::Index count = std::min(kTogether, b.cols() - first);
      ColumnsOf<T> x = u.middleCols(first, count);
      const GmresResult result =
          gmres<T>(multiply, b.middleCols(first, count), x, {tolerance_, 300}, precondition);
      if (!(result.residual <= kAcceptable * tolerance_))
        throw Error(ErrorCode::numerical,
                    "the equations of a step cannot be solved iteratively; make the archive with "
                    "--inverse dense");
      u.middleCols(first, count) = x;
    }
    return u;
  }

  const MatrixFamily& h_;
  BlockDiagonal<T, Stored> preconditioner_;
  double tolerance_;
};

/// To what the matrices know, and a little more.
template <class T, class Single>
std::unique_ptr<InitialSolver> iterative_solver(const BodyModel& model, const MatrixFamily& h) {
  const int nodes = static_cast<int>(model.nodes());
  const double tolerance = model.codec->rounding();
  if (model.codec->is_double()) return std::make_unique<IterativeSolver<T, T>>(h, nodes, tolerance);
  return std::make_unique<IterativeSolver<T, Single>>(h, nodes, tolerance);
}

}  // namespace

std::unique_ptr<InitialSolver> make_initial_solver(const BodyModel& model, int component) {
  if (!model.inverse.empty()) return std::make_unique<DirectSolver>(*model.inverse[component]);
  const MatrixFamily& h = *model.initial_h[component];
  return h.count() > 1 ? iterative_solver<Complex, std::complex<float>>(model, h)
                       : iterative_solver<double, float>(model, h);
}

}  // namespace bem
