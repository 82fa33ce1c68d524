#include "compress/block_factors.hpp"

#include "algebra/blas.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <random>

namespace bem {
namespace {

using FloatMap = Eigen::Map<const FloatMatrix>;

constexpr Eigen::Index kFirstSamples = 64;
constexpr Eigen::Index kOversampling = 8;

FloatMatrix product(const FloatMap& a, const FloatMap& b) {
  FloatMatrix c = FloatMatrix::Zero(a.rows(), b.cols());
  gemm<float>(static_cast<int>(a.rows()), static_cast<int>(b.cols()), static_cast<int>(a.cols()),
              1.0F, a.data(), static_cast<int>(a.rows()), b.data(), static_cast<int>(b.rows()),
              c.data(), static_cast<int>(c.rows()));
  return c;
}

FloatMap map(const FloatMatrix& m) {
  return FloatMap(m.data(), m.rows(), m.cols());
}

/// Random signs, the same on every machine.
FloatMap random_signs(Eigen::Index rows, Eigen::Index columns) {
  constexpr std::size_t kLeast = std::size_t(1) << 20;
  thread_local std::mt19937 random(1);
  thread_local std::vector<float> signs;
  const auto size = static_cast<std::size_t>(rows * columns);
  while (signs.size() < std::max(size, kLeast)) {
    std::uint32_t bits = random();
    for (int i = 0; i < 32; ++i, bits >>= 1) signs.push_back((bits & 1U) != 0 ? 1.0F : -1.0F);
  }
  return FloatMap(signs.data(), rows, columns);
}

/// Directions that the columns of a matrix span, sorted by what they carry.
struct Directions {
  FloatMatrix basis;   ///< orthonormal
  double dropped = 0;  ///< what was left out carries, squared; an estimate
};

/// Eigenvalues and eigenvectors of a symmetric matrix, the largest first.
struct Spectrum {
  explicit Spectrum(const Eigen::MatrixXd& gram) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
    values = solver.eigenvalues().reverse().cwiseMax(0.0);
    vectors = solver.eigenvectors().rowwise().reverse();
  }
  Eigen::Index count_above(double least) const {
    return (values.array() >= least).count();
  }
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

Eigen::MatrixXd gram(const FloatMatrix& columns) {
  const Eigen::MatrixXd wide = columns.cast<double>();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(wide.cols(), wide.cols());
  const Eigen::MatrixXd transposed = wide.transpose();
  gemm<double>(static_cast<int>(out.rows()), static_cast<int>(out.cols()),
               static_cast<int>(wide.rows()), 1.0, transposed.data(),
               static_cast<int>(transposed.rows()), wide.data(), static_cast<int>(wide.rows()),
               out.data(), static_cast<int>(out.rows()));
  return out;
}

/// Samples are products with random signs: a direction that carries sigma is in `count` of them
/// with sqrt(count) sigma.
Directions find_directions(const FloatMatrix& stacked, double least) {
  const Eigen::Index m = stacked.rows(), width = stacked.cols();
  for (Eigen::Index count = kFirstSamples;; count *= 2) {
    const double limit = least * least * static_cast<double>(count);
    if (count >= m) {  // the samples tell about every direction
      count = std::min(m + kOversampling, width);
      const FloatMatrix samples =
          count < width ? product(map(stacked), random_signs(width, count)) : stacked;
      const double scale = count < width ? static_cast<double>(count) : 1;
      const Spectrum spectrum(gram(samples.transpose()) / scale);
      const Eigen::Index kept = spectrum.count_above(least * least);
      return {spectrum.vectors.leftCols(kept).cast<float>(), spectrum.values.tail(m - kept).sum()};
    }
    const FloatMatrix samples = product(map(stacked), random_signs(width, count));
    const Spectrum spectrum(gram(samples));
    const Eigen::Index kept = spectrum.count_above(limit);
    if (kept + kOversampling > count) continue;
    const FloatMatrix turn = spectrum.vectors.leftCols(kept).cast<float>();
    const Eigen::HouseholderQR<FloatMatrix> qr(product(map(samples), map(turn)));
    return {qr.householderQ() * FloatMatrix::Identity(m, kept),
            spectrum.values.tail(count - kept).sum() / static_cast<double>(count)};
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

}  // namespace

BlockFactors factor_block(const std::vector<MatrixView<float>>& matrices, double least) {
  const Eigen::Index m = matrices[0].rows(), n = matrices[0].cols();
  const auto count = static_cast<Eigen::Index>(matrices.size());
  FloatMatrix stacked(m, n * count);
  for (Eigen::Index k = 0; k < count; ++k) stacked.middleCols(k * n, n) = matrices[k];
  BlockFactors out;
  Directions outputs = find_directions(stacked, least);
  out.output_basis = std::move(outputs.basis);
  out.squared_error = outputs.dropped;
  const Eigen::Index p = out.output_basis.cols();
  if (p > 0) {
    const FloatMatrix transposed = out.output_basis.transpose();
    const FloatMatrix rows = transposed_each(product(map(transposed), map(stacked)), count);
    Directions inputs = find_directions(rows, least);
    out.input_basis = std::move(inputs.basis);
    out.squared_error += inputs.dropped;
    const FloatMatrix to_inputs = out.input_basis.transpose();
    const FloatMatrix coupling = product(map(to_inputs), map(rows));  // C_k^T side by side
    for (Eigen::Index k = 0; k < count; ++k)
      out.coupling.emplace_back(coupling.middleCols(k * p, p).transpose());
  } else {
    out.input_basis.resize(n, 0);
    out.coupling.assign(matrices.size(), FloatMatrix(0, 0));
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

}  // namespace bem
