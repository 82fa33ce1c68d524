#include "convergence/trend.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kShrinks = 0.8, kShrinksWell = 0.5, kExplained = 0.9;
constexpr double kLeastOrder = 0.5, kMostOrder = 4, kOrderStep = 0.005;

/// Least squares for u and c with one order.
class Fit {
 public:
  Fit(const std::vector<double>& sizes, double order) {
    const auto n = static_cast<Eigen::Index>(sizes.size());
    weights_.resize(n);
    VectorXd powers(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const double ratio = sizes.back() / sizes[static_cast<std::size_t>(k)];
      weights_[k] = std::pow(ratio, 4);
      powers[k] = std::pow(1 / ratio, order);
    }
    weights_ /= weights_.sum();
    const double mean = weights_.dot(powers);
    const VectorXd centred = powers.array() - mean;
    slope_ = weights_.cwiseProduct(centred) / weights_.dot(centred.cwiseAbs2());
    limit_ = weights_ - mean * slope_;
    centred_ = centred;
  }

  /// u = sum_k limit_k u_k.
  const VectorXd& limit() const { return limit_; }

  /// Weighted sum of squares of what the model leaves, or with `model` false of u_k - mean.
  double scatter(const MatrixXd& products, bool model) const {
    double sum = 0;
    for (Eigen::Index k = 0; k < weights_.size(); ++k) {
      VectorXd rest = VectorXd::Unit(weights_.size(), k) - weights_;
      if (model) rest -= centred_[k] * slope_;
      sum += weights_[k] * rest.dot(products * rest);
    }
    return std::max(sum, 0.0);
  }

 private:
  VectorXd weights_, centred_, slope_, limit_;
};

VectorXd step(Eigen::Index n, Eigen::Index k) {
  return VectorXd::Unit(n, k + 1) - VectorXd::Unit(n, k);
}

bool differences_shrink(const MatrixXd& products) {
  const Eigen::Index n = products.rows();
  if (n < 3) return true;
  const VectorXd last = step(n, n - 2), before = step(n, n - 3);
  double largest = 0;
  for (Eigen::Index k = 0; k + 2 < n; ++k)
    largest = std::max(largest, norm_of(step(n, k), products));
  const double last_size = norm_of(last, products);
  if (last_size <= kShrinksWell * largest) return true;
  return last_size <= kShrinks * largest && before.dot(products * last) >= 0;
}

std::optional<double> order_of_fit(const std::vector<double>& sizes, const MatrixXd& products) {
  if (sizes.size() < 3) return std::nullopt;
  double best = kLeastOrder, least = Fit(sizes, best).scatter(products, true);
  for (double p = kLeastOrder; p <= kMostOrder; p += kOrderStep) {
    const double scatter = Fit(sizes, p).scatter(products, true);
    if (scatter < least) {
      least = scatter;
      best = p;
    }
  }
  const bool inside = best > kLeastOrder && best < kMostOrder - kOrderStep;
  const double all = Fit(sizes, best).scatter(products, false);
  if (!inside || least > (1 - kExplained) * all) return std::nullopt;
  return best;
}

/// The slope of the distances from a limit over sizes, both as logarithms, without the last run,
/// whose distance is the limit's own assumption. (Errors of irregular meshes have no common
/// direction, but a common size.)
std::optional<double> order_of_distances(const std::vector<double>& sizes, const MatrixXd& products,
                                         const VectorXd& limit) {
  const Eigen::Index n = products.rows() - 1;
  if (n < 3) return std::nullopt;
  VectorXd x(n), y(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    x[k] = std::log(sizes[static_cast<std::size_t>(k)]);
    y[k] = std::log(norm_of(limit - VectorXd::Unit(n + 1, k), products));
  }
  x.array() -= x.mean();
  y.array() -= y.mean();
  const double slope = x.dot(y) / x.squaredNorm();
  const bool explained = slope * x.dot(y) >= kExplained * y.squaredNorm();
  if (!explained || !(slope > kLeastOrder && slope < kMostOrder)) return std::nullopt;
  return slope;
}

}  // namespace

double norm_of(const VectorXd& weights, const MatrixXd& products) {
  return std::sqrt(std::max(weights.dot(products * weights), 0.0));
}

Trend find_trend(const std::vector<double>& sizes, const MatrixXd& products,
                 double expected_order) {
  Trend trend;
  trend.converges = differences_shrink(products);
  trend.limit = VectorXd::Unit(products.rows(), products.rows() - 1);
  if (!trend.converges) return trend;
  trend.limit = Fit(sizes, expected_order).limit();
  trend.order = order_of_fit(sizes, products);
  if (!trend.order) trend.order = order_of_distances(sizes, products, trend.limit);
  if (trend.order && *trend.order < expected_order) trend.limit = Fit(sizes, *trend.order).limit();
  return trend;
}

}  // namespace bem
