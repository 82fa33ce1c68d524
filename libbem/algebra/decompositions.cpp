#include "algebra/decompositions.hpp"

#include <Eigen/Dense>

namespace bem {

Eigensystem eigensystem(const RealMatrix& a) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigensystem eigensystem(const ComplexMatrix& a) {
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXcd eigenvalues(const RealMatrix& a) {
  return Eigen::MatrixXd(a).eigenvalues();
}

Eigen::VectorXcd eigenvalues(const ComplexMatrix& a) {
  return Eigen::MatrixXcd(a).eigenvalues();
}

SymmetricEigensystem symmetric_eigensystem(const RealMatrix& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd generalized_eigenvalues(const RealMatrix& a, const RealMatrix& b) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(a, b, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

LeftSingularSystem left_singular_system(const RealMatrix& a) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU);
  return {svd.singularValues(), svd.matrixU()};
}

SingularSystem singular_system(const ComplexMatrix& a) {
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

Eigen::MatrixXd orthonormal_basis(const RealMatrix& a) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(a).householderQ() *
         Eigen::MatrixXd::Identity(a.rows(), a.cols());
}

Eigen::MatrixXcd orthonormal_basis(const ComplexMatrix& a) {
  return Eigen::HouseholderQR<Eigen::MatrixXcd>(a).householderQ() *
         Eigen::MatrixXcd::Identity(a.rows(), a.cols());
}

Eigen::MatrixXd inverse(const RealMatrix& a) {
  return Eigen::MatrixXd(a).inverse();
}

Eigen::MatrixXcd inverse(const ComplexMatrix& a) {
  return Eigen::MatrixXcd(a).inverse();
}

Eigen::MatrixXd pseudo_inverse(const RealMatrix& a) {
  return Eigen::MatrixXd(a).completeOrthogonalDecomposition().pseudoInverse();
}

Eigen::MatrixXd least_squares(const RealMatrix& a, const RealMatrix& b, double threshold) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  if (threshold > 0) qr.setThreshold(threshold);
  return qr.compute(a).solve(b);
}

Eigen::MatrixXcd least_squares(const ComplexMatrix& a, const ComplexMatrix& b) {
  return Eigen::MatrixXcd(a).colPivHouseholderQr().solve(b);
}

}  // namespace bem
