#include "compress/block_factors.hpp"

#include "algebra/blas.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace bem {
namespace {

using FloatMap = Eigen::Map<const FloatMatrix>;

constexpr Eigen::Index kFirstSamples = 64;
constexpr Eigen::Index kProbes = 8;  ///< samples that only tell the error
constexpr double kMostLeft = 4;      ///< light directions that the samples may miss

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

/// Eigenvalues and eigenvectors of a symmetric matrix, the largest first.
struct Spectrum {
  explicit Spectrum(const Eigen::MatrixXd& gram) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
    values = solver.eigenvalues().reverse().cwiseMax(0.0);
    vectors = solver.eigenvectors().rowwise().reverse();
  }
  Eigen::Index count_above(double least) const { return (values.array() >= least).count(); }
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// a^T a in double precision.
Eigen::MatrixXd gram(const FloatMatrix& a) {
  const Eigen::MatrixXd wide = a.cast<double>(), transposed = wide.transpose();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(wide.cols(), wide.cols());
  gemm<double>(static_cast<int>(out.rows()), static_cast<int>(out.cols()),
               static_cast<int>(wide.rows()), 1.0, transposed.data(),
               static_cast<int>(transposed.rows()), wide.data(), static_cast<int>(wide.rows()),
               out.data(), static_cast<int>(out.rows()));
  return out;
}

/// Directions that the columns of a matrix span, sorted by what they carry.
struct Directions {
  FloatMatrix basis;      ///< orthonormal
  FloatMatrix projected;  ///< basis^T times the matrix
  double dropped = 0;     ///< what was left out carries, squared; partly an estimate
};

/// Turns a basis and what is projected onto it so that its directions are the principal ones, and
/// drops those that carry less than `least`.
Directions principal(FloatMatrix basis, FloatMatrix projected, double least) {
  const Spectrum spectrum(gram(projected.transpose()));
  const Eigen::Index kept = spectrum.count_above(least * least);
  const FloatMatrix turn = spectrum.vectors.leftCols(kept).cast<float>();
  const FloatMatrix turn_back = turn.transpose();
  Directions out;
  out.basis = basis.size() == 0 ? turn : product(map(basis), map(turn));
  out.projected = product(map(turn_back), map(projected));
  out.dropped = spectrum.values.tail(spectrum.values.size() - kept).sum();
  return out;
}

/// The space of enough samples, products with random signs, holds all directions that count;
/// further samples tell what it leaves.
Directions find_directions(const FloatMatrix& stacked, double least) {
  const Eigen::Index m = stacked.rows();
  for (Eigen::Index count = kFirstSamples;; count += count / 2) {
    if (4 * count > 3 * m) return principal({}, stacked, least);
    const FloatMatrix samples =
        product(map(stacked), random_signs(stacked.cols(), count + kProbes));
    const Eigen::HouseholderQR<FloatMatrix> qr(samples.leftCols(count));
    FloatMatrix basis = qr.householderQ() * FloatMatrix::Identity(m, count);
    const FloatMatrix transposed = basis.transpose();
    FloatMatrix probes = samples.rightCols(kProbes);
    probes -= basis * (transposed * probes);
    const double left = probes.cast<double>().squaredNorm() / kProbes;
    if (left > kMostLeft * least * least) continue;
    Directions out = principal(std::move(basis), product(map(transposed), map(stacked)), least);
    out.dropped += left;
    return out;
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
    Directions inputs = find_directions(transposed_each(outputs.projected, count), least);
    out.input_basis = std::move(inputs.basis);
    out.squared_error += inputs.dropped;
    for (Eigen::Index k = 0; k < count; ++k)  // side by side are the C_k^T
      out.coupling.emplace_back(inputs.projected.middleCols(k * p, p).transpose());
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
