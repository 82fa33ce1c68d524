#include "support/nonlinear_eigenvalues.hpp"

#include "algebra/decompositions.hpp"
#include "algebra/lu.hpp"

#include <random>
#include <stdexcept>

namespace bem_test {

Eigen::MatrixXcd random_block(Eigen::Index rows, Eigen::Index columns) {
  std::mt19937 random(1);  // the same numbers on every machine
  const auto number = [&random] { return random() / 2147483648.0 - 1; };
  Eigen::MatrixXcd v(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = 0; i < rows; ++i) v(i, j) = bem::Complex(number(), number());
  return v;
}

std::vector<Eigenpair> eigenpairs_in_disc(const MatrixFunction& t, const Disc& disc,
                                          const Eigen::MatrixXcd& block,
                                          const ContourSearch& search) {
  Eigen::MatrixXcd a0 = Eigen::MatrixXcd::Zero(block.rows(), block.cols()), a1 = a0;
  for (int n = 0; n < search.points; ++n) {
    const bem::Lu<bem::Complex> lu(t(disc.point(n, search.points)));
    Eigen::MatrixXcd x = block;
    lu.solve(x);
    const bem::Complex m = std::polar(1.0, 2 * bem::kPi * n / search.points);
    a0 += m / static_cast<double>(search.points) * x;
    a1 += m * m / static_cast<double>(search.points) * x;
  }
  const bem::SingularSystem svd = bem::singular_system(a0);
  const Eigen::VectorXd& s = svd.values;
  Eigen::Index rank = 0;
  while (rank < s.size() && s[rank] > search.rank_tolerance * s[0]) ++rank;
  if (rank == block.cols() && rank > 1)
    throw std::runtime_error("more eigenvalues near the disc than columns");
  const Eigen::MatrixXcd u = svd.left.leftCols(rank);
  const Eigen::MatrixXcd reduced =
      u.adjoint() * a1 * svd.right.leftCols(rank) * s.head(rank).cwiseInverse().asDiagonal();
  const bem::Eigensystem system = bem::eigensystem(reduced);
  std::vector<Eigenpair> found;
  for (Eigen::Index i = 0; i < rank; ++i) {
    const bem::Complex m = system.values[i];
    if (std::abs(m) > 1) continue;
    Eigenpair pair;
    pair.value = disc.centre + disc.radius * m;
    pair.vector = (u * system.vectors.col(i)).normalized();
    const Eigen::MatrixXcd at = t(pair.value);
    pair.residual = (at * pair.vector).norm() / at.norm() * std::sqrt(double(at.cols()));
    if (pair.residual <= search.residual_limit) found.push_back(std::move(pair));
  }
  return found;
}

MatrixPolynomial::MatrixPolynomial(const MatrixFunction& f, const Disc& disc, int points)
    : disc_(disc) {
  std::vector<Eigen::MatrixXcd> values;
  for (int n = 0; n < points; ++n) values.push_back(f(disc.point(n, points)));
  for (int k = 0; k < points; ++k) {
    coefficients_.emplace_back(Eigen::MatrixXcd::Zero(values[0].rows(), values[0].cols()));
    for (int n = 0; n < points; ++n)
      coefficients_[k] += std::polar(1.0 / points, -2 * bem::kPi * k * n / points) * values[n];
  }
}

Eigen::MatrixXcd MatrixPolynomial::operator()(bem::Complex z) const {
  const bem::Complex m = (z - disc_.centre) / disc_.radius;
  Eigen::MatrixXcd sum = coefficients_.back();
  for (auto c = coefficients_.rbegin() + 1; c != coefficients_.rend(); ++c) sum = sum * m + *c;
  return sum;
}

}  // namespace bem_test
