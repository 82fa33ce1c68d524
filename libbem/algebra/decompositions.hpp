#pragma once

#include <Eigen/Core>

namespace bem {

// Decompositions of small dense matrices. They are those of Eigen, compiled here once: as templates
// they cost every source that uses one of them seconds.

using RealMatrix = Eigen::Ref<const Eigen::MatrixXd>;
using ComplexMatrix = Eigen::Ref<const Eigen::MatrixXcd>;

/// Eigenvalues and eigenvectors (columns of norm 1) of a square matrix.
struct Eigensystem {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
Eigensystem eigensystem(const RealMatrix& a);
Eigensystem eigensystem(const ComplexMatrix& a);
Eigen::VectorXcd eigenvalues(const RealMatrix& a);
Eigen::VectorXcd eigenvalues(const ComplexMatrix& a);

/// Eigenvalues, ascending, and orthonormal eigenvectors of a symmetric matrix.
struct SymmetricEigensystem {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigensystem symmetric_eigensystem(const RealMatrix& a);
/// The values x with a v = x b v, ascending, for symmetric a and symmetric positive definite b.
Eigen::VectorXd generalized_eigenvalues(const RealMatrix& a, const RealMatrix& b);

/// Singular values, descending, of an m x n matrix and its left singular vectors, m x min(m, n).
struct LeftSingularSystem {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
LeftSingularSystem left_singular_system(const RealMatrix& a);
/// The same of a complex matrix, with the right singular vectors, n x min(m, n).
struct SingularSystem {
  Eigen::VectorXd values;
  Eigen::MatrixXcd left, right;
};
SingularSystem singular_system(const ComplexMatrix& a);

/// Orthonormal columns that span the space of the columns of a, by Householder reflections.
Eigen::MatrixXd orthonormal_basis(const RealMatrix& a);
Eigen::MatrixXcd orthonormal_basis(const ComplexMatrix& a);

/// Inverse of a regular matrix; it is not finite if the matrix is singular.
Eigen::MatrixXd inverse(const RealMatrix& a);
Eigen::MatrixXcd inverse(const ComplexMatrix& a);
Eigen::MatrixXd pseudo_inverse(const RealMatrix& a);

/// x that minimises |a x - b|, column by column. Columns of a whose pivot is below `threshold`
/// times the largest do not count; by default that is a few roundings.
Eigen::MatrixXd least_squares(const RealMatrix& a, const RealMatrix& b, double threshold = 0);
Eigen::MatrixXcd least_squares(const ComplexMatrix& a, const ComplexMatrix& b);

}  // namespace bem
