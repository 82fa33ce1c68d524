#pragma once

#include "compress/matrix_family.hpp"
#include "mesh/bisection.hpp"

#include <cmath>

namespace bem_test {

constexpr int kMatrices = 3;

/// Matrices with the kind of entries that ours have: smooth functions of distance and direction, of
/// other ranges from matrix to matrix, with large own blocks in the first.
struct MatrixExample {
  std::vector<bem::Vec3> nodes;
  std::vector<Eigen::MatrixXf> matrices;
  double norm = 0;

  /// `range`: how quickly the entries decay.
  explicit MatrixExample(const std::vector<bem::Vec3>& points, double range = 1) {
    for (int i : bem::bisection_order(points)) nodes.push_back(points[i]);
    const auto n = static_cast<Eigen::Index>(nodes.size());
    for (int k = 0; k < kMatrices; ++k) {
      Eigen::MatrixXf m(3 * n, 3 * n);
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
          const bem::Vec3 r = nodes[j] - nodes[i];
          const double decay = std::exp(-range * r.squaredNorm() * (k + 1));
          const bem::Mat3 block = decay * (bem::Mat3::Identity() + r * r.transpose()) +
                                  (k == 0 && i == j ? 5.0 : 0.0) * bem::Mat3::Identity();
          m.block<3, 3>(3 * i, 3 * j) = block.cast<float>();
        }
      norm += m.cast<double>().squaredNorm();
      matrices.push_back(std::move(m));
    }
    norm = std::sqrt(norm);
  }

  double error_of(const bem::MatrixFamily& family) const {
    double sum = 0;
    for (int k = 0; k < kMatrices; ++k)
      sum += (full_matrix(family, k) - matrices[k].cast<double>()).squaredNorm();
    return std::sqrt(sum) / norm;
  }
};

/// Sums of half the products of columns of x with the matrices in turn, added to ones.
inline Eigen::MatrixXd products(const bem::MatrixFamily& family, const Eigen::MatrixXd& x,
                                int outputs) {
  Eigen::MatrixXf coefficients(static_cast<Eigen::Index>(family.coefficients()), x.cols());
  Eigen::MatrixXd y = Eigen::MatrixXd::Ones(x.rows(), outputs);
  std::vector<bem::FamilyTerm> terms;
  std::vector<double*> out;
  for (int o = 0; o < outputs; ++o) out.push_back(y.col(o).data());
  family.analyse_columns(x, coefficients);
  for (int c = 0; c < static_cast<int>(x.cols()); ++c)
    terms.push_back({c % kMatrices, x.col(c).data(), coefficients.col(c).data(), c % outputs, 0.5});
  family.multiply_add(terms, out);
  return y;
}

}  // namespace bem_test
