#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace bem {

/// What a series of runs on finer and finer levels comes to, if it comes to something.
///
/// The runs are vectors u_k of a space with a scalar product, known by the products of their
/// differences from any vector of that space, and have sizes h_k (edge lengths or time steps). The
/// model is
///
///   u_k = u + c h_k^p,
///
/// with u and c from least squares, in which the run k has the weight (h_last/h_k)^4, because what
/// the model leaves out grows with the size (Eca and Hoekstra 2014, for vectors).
struct Trend {
  /// The last difference between neighbours is at most half of the largest one, or at most 0.8 of
  /// it and not against the one before. (Runs without anything in common have differences of one
  /// size that go to and fro.) Of two runs alone it cannot be told: true.
  bool converges = false;
  /// p, 0.5 to 4, if the model explains 90 % of the scatter of the runs; else, of four runs or
  /// more, the power of the sizes that explains as much of their distances from the limit.
  std::optional<double> order;
  /// u = sum_k limit_k u_k with the observed order, but at most the expected one, and with that if
  /// none is observed; sum 1. The last run where nothing converges.
  Eigen::VectorXd limit;
};

/// `sizes`: at least two, falling. `products`: of the differences, runs x runs, positive
/// semidefinite.
Trend find_trend(const std::vector<double>& sizes, const Eigen::MatrixXd& products,
                 double expected_order);

/// Norm of sum_k weights_k u_k for weights of sum 0, from the products of differences.
double norm_of(const Eigen::VectorXd& weights, const Eigen::MatrixXd& products);

}  // namespace bem
