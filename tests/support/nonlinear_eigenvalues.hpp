#pragma once

#include "base/types.hpp"

#include <functional>

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
Eigen::MatrixXcd random_block(Eigen::Index rows, Eigen::Index columns);

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
std::vector<Eigenpair> eigenpairs_in_disc(const MatrixFunction& t, const Disc& disc,
                                          const Eigen::MatrixXcd& block,
                                          const ContourSearch& search = {});

/// Polynomial that interpolates an analytic matrix function at evenly spaced points of a circle,
/// for functions that are expensive to evaluate. For exp(-s d) the error inside falls like
/// (d radius)^points / points!.
class MatrixPolynomial {
 public:
  MatrixPolynomial(const MatrixFunction& f, const Disc& disc, int points);

  Eigen::MatrixXcd operator()(bem::Complex z) const;
  const Disc& disc() const { return disc_; }

 private:
  Disc disc_;
  std::vector<Eigen::MatrixXcd> coefficients_;
};

}  // namespace bem_test
