#include "compress/block_factors.hpp"

#include "algebra/blas.hpp"
#include "algebra/decompositions.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Cholesky>

namespace bem {
namespace {

using FloatMap = Eigen::Map<const FloatMatrix>;

constexpr Eigen::Index kFirstSamples = 60;
constexpr double kMostLeft = 4;         ///< light directions that the samples may miss
constexpr double kFarFromEnough = 100;  ///< light directions
constexpr double kMostCut = 0.5;  ///< light directions that are cut off with those of the samples

/// a b.
template <class A, class B>
auto product(const A& a, const B& b) {
  using T = typename A::Scalar;
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> c =
      Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>::Zero(a.rows(), b.cols());
  gemm<T>(static_cast<int>(a.rows()), static_cast<int>(b.cols()), static_cast<int>(a.cols()), T(1),
          a.data(), static_cast<int>(a.rows()), b.data(), static_cast<int>(b.rows()), c.data(),
          static_cast<int>(c.rows()));
  return c;
}

/// Some random signs from an endless sequence, the same on every machine. Good until the next call.
FloatMap random_signs(Eigen::Index begin, Eigen::Index rows, Eigen::Index columns) {
  constexpr std::size_t kLeast = std::size_t(1) << 20;
  thread_local std::mt19937 random(1);
  thread_local std::vector<float> signs;
  const auto end = static_cast<std::size_t>(begin + rows * columns);
  while (signs.size() < std::max(end, kLeast)) {
    std::uint32_t bits = random();
    for (int i = 0; i < 32; ++i, bits >>= 1) signs.push_back((bits & 1U) != 0 ? 1.0F : -1.0F);
  }
  return FloatMap(signs.data() + begin, rows, columns);
}

/// Products of `count` matrices side by side with random vectors. Groups of them share the sum of
/// the matrices with random signs that they are taken of, so that a sample costs little more than
/// one of a single matrix.
FloatMatrix sample(const FloatMatrix& stacked, Eigen::Index count, Eigen::Index group,
                   Eigen::Index groups, Eigen::Index seed) {
  const Eigen::Index m = stacked.rows(), n = stacked.cols() / count, size = m * n;
  FloatMatrix sums = FloatMatrix::Zero(size, groups);
  gemm<float>(static_cast<int>(size), static_cast<int>(groups), static_cast<int>(count), 1.0F,
              stacked.data(), static_cast<int>(size), random_signs(seed, count, groups).data(),
              static_cast<int>(count), sums.data(), static_cast<int>(size));
  FloatMatrix out(m, group * groups);
  for (Eigen::Index g = 0; g < groups; ++g)
    out.middleCols(g * group, group) =
        product(FloatMap(sums.col(g).data(), m, n),
                random_signs(seed + count * groups + g * n * group, n, group));
  return out;
}

/// a a^T, summed in numbers of type T; of the symmetric result only tiles on and below the diagonal
/// are computed. Some columns of a at a time, which stay in the cache.
template <class T, class Matrix>
Eigen::MatrixXd gram(const Matrix& a) {
  using Numbers = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  constexpr Eigen::Index kColumns = 256, kTile = 48;
  const Eigen::Index m = a.rows();
  Numbers out = Numbers::Zero(m, m), part, transposed;
  for (Eigen::Index first = 0; first < a.cols(); first += kColumns) {
    const Eigen::Index count = std::min(kColumns, a.cols() - first);
    part = a.middleCols(first, count).template cast<T>();
    transposed = part.transpose();
    for (Eigen::Index i = 0; i < m; i += kTile)
      gemm<T>(static_cast<int>(m - i), static_cast<int>(std::min(kTile, m - i)),
              static_cast<int>(count), T(1), part.data() + i, static_cast<int>(m),
              transposed.data() + i * count, static_cast<int>(count), &out(i, i),
              static_cast<int>(m));
  }
  return Numbers(out.template selfadjointView<Eigen::Lower>()).template cast<double>();
}

/// Directions that the columns of a matrix span, sorted by what they carry.
struct Directions {
  FloatMatrix basis;      ///< orthonormal
  FloatMatrix projected;  ///< basis^T times the matrix
  double dropped = 0;     ///< what was left out carries, squared; partly an estimate
};

/// Cholesky factor of a Gram matrix with pivots.
struct PivotedCholesky {
  /// Stops when what is left carries at most `cut`, squared.
  PivotedCholesky(Eigen::MatrixXd gram, double cut) {
    constexpr double kRounding = 1e-14;  // of the largest pivot
    constexpr Eigen::Index kBlock = 24;
    const Eigen::Index m = gram.rows();
    Eigen::VectorXd left = gram.diagonal();
    const double rounding = kRounding * left.maxCoeff();
    factor.resize(m, m);
    Eigen::Index rank = 0, block = 0;  // columns so far, and those that `gram` is free of
    for (; rank < m && left.sum() > cut; ++rank) {
      if (rank == block + kBlock) {
        const Eigen::MatrixXd part = factor.middleCols(block, kBlock), turned = part.transpose();
        gemm<double>(static_cast<int>(m), static_cast<int>(m), static_cast<int>(kBlock), -1.0,
                     part.data(), static_cast<int>(m), turned.data(), static_cast<int>(kBlock),
                     gram.data(), static_cast<int>(m));
        block = rank;
      }
      Eigen::Index pivot = 0;
      const double largest = left.maxCoeff(&pivot);
      if (largest <= rounding) break;
      auto column = factor.col(rank);
      column = gram.col(pivot);
      column.noalias() -= factor.middleCols(block, rank - block) *
                          factor.row(pivot).segment(block, rank - block).transpose();
      column /= std::sqrt(largest);
      left = (left - column.cwiseAbs2()).cwiseMax(0.0);
      left[pivot] = 0;
      pivots.push_back(pivot);
    }
    factor.conservativeResize(Eigen::NoChange, rank);
  }

  Eigen::MatrixXd factor;            ///< m x rank, the heaviest column first
  std::vector<Eigen::Index> pivots;  ///< rank of them
};

/// Replaces the columns of a (m x r), the heaviest first, by an orthonormal basis of their space:
/// Cholesky factorisation of their Gram matrix, twice for orthogonality.
void orthonormalise(Eigen::MatrixXd& a) {
  for (int pass = 0; pass < 2 && a.cols() > 0; ++pass) {
    const Eigen::MatrixXd upper = gram<double>(a.transpose()).llt().matrixU();
    trsm<double>(Side::right, TriangleShape::upper, static_cast<int>(a.rows()),
                 static_cast<int>(a.cols()), upper.data(), static_cast<int>(a.cols()), a.data(),
                 static_cast<int>(a.rows()));
  }
}

/// Turns a basis (of all rows if it is empty) and what is projected onto it so that its directions
/// are about the principal ones, and drops those that carry less than `least`. The directions are
/// those of the pivoted QLP decomposition (Stewart 1999), and of one step of subspace iteration.
Directions principal(const FloatMatrix& basis, const FloatMatrix& projected, double least) {
  constexpr double kSingle = 5e5;  // light directions: up to here single precision tells them
  const bool single = projected.squaredNorm() < kSingle * least * least;
  const Eigen::MatrixXd products = single ? gram<float>(projected) : gram<double>(projected);
  Eigen::MatrixXd turn = PivotedCholesky(products, kMostCut * least * least).factor;
  orthonormalise(turn);
  turn = product(products, turn);
  orthonormalise(turn);
  const Eigen::VectorXd carried =
      product(products, turn).cwiseProduct(turn).colwise().sum().transpose();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < carried.size(); ++i)
    if (carried[i] >= least * least) kept.push_back(i);
  std::stable_sort(kept.begin(), kept.end(),
                   [&](Eigen::Index i, Eigen::Index j) { return carried[i] > carried[j]; });
  const FloatMatrix sorted = turn(Eigen::all, kept).cast<float>(), back = sorted.transpose();
  Directions out;
  out.basis = basis.size() == 0 ? sorted : product(basis, sorted);
  out.projected = product(back, projected);
  out.dropped = std::max(0.0, products.trace() - carried(kept).sum());
  return out;
}

/// Orthonormal directions of the columns of a matrix, until the others carry at most `cut` in all
/// (squared, per column).
FloatMatrix graded_basis(const FloatMatrix& samples, double cut) {
  const auto count = static_cast<double>(samples.cols());
  const PivotedCholesky heaviest(gram<double>(samples.transpose()), cut * count);
  Eigen::MatrixXd basis = samples(Eigen::all, heaviest.pivots).cast<double>();
  orthonormalise(basis);
  return basis.cast<float>();
}

/// The space of enough samples holds all directions that count; further samples tell what it
/// leaves. `stacked`: `count` matrices side by side.
Directions find_directions(const FloatMatrix& stacked, Eigen::Index count, double least) {
  constexpr Eigen::Index kGroup = 12, kProbeGroup = 4, kProbeGroups = 3;
  constexpr Eigen::Index kProbes = kProbeGroup * kProbeGroups;
  const Eigen::Index m = stacked.rows(), n = stacked.cols() / count;
  if (4 * kFirstSamples > m) return principal({}, stacked, least);
  Eigen::Index seed = 0;
  const auto take = [&](Eigen::Index group, Eigen::Index groups) {
    const Eigen::Index begin = seed;
    seed += groups * (count + n * group);
    return sample(stacked, count, group, groups, begin);
  };
  FloatMatrix probes = take(kProbeGroup, kProbeGroups);
  FloatMatrix samples = take(kGroup, kFirstSamples / kGroup);
  for (;;) {
    FloatMatrix basis = graded_basis(samples, kMostCut * least * least);
    const FloatMatrix transposed = basis.transpose();
    FloatMatrix rest = probes;
    if (basis.cols() > 0) rest -= product(basis, product(transposed, probes));
    const double left = rest.cast<double>().squaredNorm() / kProbes;
    if (left <= kMostLeft * least * least) {
      if (basis.cols() == 0) return {basis, FloatMatrix(0, stacked.cols()), left};
      Directions out = principal(std::move(basis), product(transposed, stacked), least);
      out.dropped += left;
      return out;
    }
    // samples that are far from enough, or as many as half of the rows, cost more than they save
    const Eigen::Index more = (samples.cols() / 2 + kGroup - 1) / kGroup;
    const Eigen::Index next = samples.cols() + more * kGroup;
    const bool far = left > kFarFromEnough * least * least;
    if (2 * (far ? next + next / 2 : next) > m) return principal({}, stacked, least);
    const FloatMatrix further = take(kGroup, more);
    samples.conservativeResize(Eigen::NoChange, samples.cols() + further.cols());
    samples.rightCols(further.cols()) = further;
  }
}

/// Puts the transposes of the `count` matrices of a row of matrices side by side.
FloatMatrix transposed_each(const FloatMatrix& row, Eigen::Index count) {
  const Eigen::Index m = row.rows(), n = row.cols() / count;
  FloatMatrix out(n, m * count);
  for (Eigen::Index k = 0; k < count; ++k)
    out.middleCols(k * m, m) = row.middleCols(k * n, n).transpose();
  return out;
}

/// From the directions of the outputs of `count` matrices with n columns.
BlockFactors with_inputs(Directions outputs, Eigen::Index count, Eigen::Index n, double least) {
  BlockFactors out;
  out.output_basis = std::move(outputs.basis);
  out.squared_error = outputs.dropped;
  const Eigen::Index p = out.output_basis.cols();
  if (p > 0) {
    Directions inputs = find_directions(transposed_each(outputs.projected, count), count, least);
    out.input_basis = std::move(inputs.basis);
    out.squared_error += inputs.dropped;
    for (Eigen::Index k = 0; k < count; ++k)  // side by side are the C_k^T
      out.coupling.emplace_back(inputs.projected.middleCols(k * p, p).transpose());
  } else {
    out.input_basis.resize(n, 0);
    out.coupling.assign(count, FloatMatrix(0, 0));
  }
  out.output_weights.setZero(p);
  out.input_weights.setZero(out.input_basis.cols());
  for (const FloatMatrix& c : out.coupling) {
    out.output_weights.array() += c.rowwise().squaredNorm().array();
    out.input_weights.array() += c.colwise().squaredNorm().transpose().array();
  }
  out.output_weights = out.output_weights.cwiseSqrt();
  out.input_weights = out.input_weights.cwiseSqrt();
  return out;
}

}  // namespace

BlockFactors factor_block(const std::vector<MatrixView<float>>& matrices, double least) {
  const Eigen::Index m = matrices[0].rows(), n = matrices[0].cols();
  const auto count = static_cast<Eigen::Index>(matrices.size());
  FloatMatrix stacked(m, n * count);
  for (Eigen::Index k = 0; k < count; ++k) stacked.middleCols(k * n, n) = matrices[k];
  return with_inputs(find_directions(stacked, count, least), count, n, least);
}

BlockFactors factor_block(const FactoredBlock& block, double least) {
  const Eigen::MatrixXd outputs = block.outputs->cast<double>();
  const Eigen::Index m = outputs.rows(), n = block.inputs.at(0)->cols();
  const auto count = static_cast<Eigen::Index>(block.inputs.size());
  const Eigen::MatrixXd basis =
      outputs.cols() < m ? orthonormal_basis(outputs) : Eigen::MatrixXd::Identity(m, m);
  const FloatMatrix turn = (basis.transpose() * outputs).cast<float>();
  FloatMatrix stacked(turn.rows(), n * count);
  for (Eigen::Index k = 0; k < count; ++k)
    stacked.middleCols(k * n, n) = product(turn, *block.inputs[k]);
  BlockFactors out = with_inputs(principal(basis.cast<float>(), stacked, least), count, n, least);
  out.squared_norm = stacked.cast<double>().squaredNorm();
  return out;
}

}  // namespace bem
