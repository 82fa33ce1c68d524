#pragma once

#include "algebra/lu.hpp"

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

namespace bem_test {

/// A square matrix that depends analytically on a complex number.
using MatrixFunction = std::function<Eigen::MatrixXcd(bem::Complex)>;

/// A number z and a unit vector v with T(z) v = 0.
struct Eigenpair {
  bem::Complex value;
  Eigen::VectorXcd vector;
  double residual;  ///< |T(z) v|, relative to the mean length of the columns of T(z)
};

struct Disc {
  bem::Complex centre;
  double radius;

  /// The n-th of `count` points that divide the circle evenly.
  bem::Complex point(int n, int count) const {
    return centre + std::polar(radius, 2 * bem::kPi * n / count);
  }
};

struct ContourSearch {
  int points = 32;               ///< quadrature points on the circle
  double rank_tolerance = 1e-8;  ///< singular values below it, relative to the largest, are noise
  double residual_limit = 1e-6;  ///< what exceeds it is no eigenpair
};

/// Right-hand sides with random entries in the unit square: modes of any symmetry are found.
inline Eigen::MatrixXcd random_block(Eigen::Index rows, Eigen::Index columns) {
  std::mt19937 random(1);  // the same numbers on every machine
  const auto number = [&random] { return random() / 2147483648.0 - 1; };
  Eigen::MatrixXcd v(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = 0; i < rows; ++i) v(i, j) = bem::Complex(number(), number());
  return v;
}

/// All eigenpairs of T in a disc, each as often as its multiplicity, by Beyn's contour method
/// [W.-J. Beyn, An integral method for solving nonlinear eigenvalue problems, Linear Algebra Appl.
/// 436 (2012) 3839-3863, integral algorithm 1]: with the moments of the scaled variable m = (z -
/// centre)/radius
///   A_p = 1/(2 pi i) int m^p T(z)^{-1} V dm,   A_0 = U S W^H cut off at its numerical rank,
/// the eigenvalues are those of U^H A_1 W S^{-1}. The trapezoidal rule with n points weighs an
/// eigenvalue at m by 1/(1 - m^n) in both moments, so neighbours just outside do no harm as long as
/// the block V has columns left for them. Vectors V with a symmetry find only the modes that have
/// it.
/// Throws if the columns do not suffice. Cost: `points` factorisations.
inline std::vector<Eigenpair> eigenpairs_in_disc(const MatrixFunction& t, const Disc& disc,
                                                 const Eigen::MatrixXcd& block,
                                                 const ContourSearch& search = {}) {
  Eigen::MatrixXcd a0 = Eigen::MatrixXcd::Zero(block.rows(), block.cols()), a1 = a0;
  for (int n = 0; n < search.points; ++n) {
    const bem::Lu<bem::Complex> lu(t(disc.point(n, search.points)));
    Eigen::MatrixXcd x = block;
    lu.solve(x);
    const bem::Complex m = std::polar(1.0, 2 * bem::kPi * n / search.points);
    a0 += m / static_cast<double>(search.points) * x;
    a1 += m * m / static_cast<double>(search.points) * x;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(a0, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& s = svd.singularValues();
  Eigen::Index rank = 0;
  while (rank < s.size() && s[rank] > search.rank_tolerance * s[0]) ++rank;
  if (rank == block.cols() && rank > 1)
    throw std::runtime_error("more eigenvalues near the disc than columns");
  const Eigen::MatrixXcd u = svd.matrixU().leftCols(rank);
  const Eigen::MatrixXcd reduced =
      u.adjoint() * a1 * svd.matrixV().leftCols(rank) * s.head(rank).cwiseInverse().asDiagonal();
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(reduced);
  std::vector<Eigenpair> found;
  for (Eigen::Index i = 0; i < rank; ++i) {
    const bem::Complex m = solver.eigenvalues()[i];
    if (std::abs(m) > 1) continue;
    Eigenpair pair;
    pair.value = disc.centre + disc.radius * m;
    pair.vector = (u * solver.eigenvectors().col(i)).normalized();
    const Eigen::MatrixXcd at = t(pair.value);
    pair.residual = (at * pair.vector).norm() / at.norm() * std::sqrt(double(at.cols()));
    if (pair.residual <= search.residual_limit) found.push_back(std::move(pair));
  }
  return found;
}

/// Polynomial that interpolates an analytic matrix function at evenly spaced points of a circle,
/// for functions that are expensive to evaluate. For exp(-s d) the error inside falls like
/// (d radius)^points / points!.
class MatrixPolynomial {
 public:
  MatrixPolynomial(const MatrixFunction& f, const Disc& disc, int points) : disc_(disc) {
    std::vector<Eigen::MatrixXcd> values;
    for (int n = 0; n < points; ++n) values.push_back(f(disc.point(n, points)));
    for (int k = 0; k < points; ++k) {
      coefficients_.emplace_back(Eigen::MatrixXcd::Zero(values[0].rows(), values[0].cols()));
      for (int n = 0; n < points; ++n)
        coefficients_[k] += std::polar(1.0 / points, -2 * bem::kPi * k * n / points) * values[n];
    }
  }

  Eigen::MatrixXcd operator()(bem::Complex z) const {
    const bem::Complex m = (z - disc_.centre) / disc_.radius;
    Eigen::MatrixXcd sum = coefficients_.back();
    for (auto c = coefficients_.rbegin() + 1; c != coefficients_.rend(); ++c) sum = sum * m + *c;
    return sum;
  }
  const Disc& disc() const { return disc_; }

 private:
  Disc disc_;
  std::vector<Eigen::MatrixXcd> coefficients_;
};

}  // namespace bem_test
