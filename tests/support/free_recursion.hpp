#pragma once

#include "model/body_model.hpp"

#include <functional>

namespace bem_test {

/// Amplification factor per step of the scheme for y' = (w/dt) y: the root near e^w of
/// Delta(1/z) = w for the multistep methods, R(w) = (1 + w/3)/(1 - 2w/3 + w^2/6) for Radau IIA.
bem::Complex amplification(const bem::Scheme& scheme, bem::Complex w);

/// The inverse: w/dt is the frequency of the discretised body that a free motion with the factor z
/// per step belongs to; the eigenvalue of Delta(1/z) nearest to log z.
bem::Complex frequency_of(const bem::Scheme& scheme, bem::Complex z);

/// T(z) = sum_k H_k z^{-k} of the free motions u_n = z^n v of a body in a stationary frame, from
/// the matrices that a model stores. Unknowns: 3N of the first stage, then 3N of the second.
class FreeRecursion {
 public:
  explicit FreeRecursion(const bem::BodyModel& model);

  Eigen::MatrixXcd operator()(bem::Complex z) const;

  const bem::Scheme& scheme() const { return scheme_; }
  /// Displacements at the end of the step, the last stage, of a vector of all stages.
  Eigen::VectorXcd displacement(const Eigen::VectorXcd& stages) const { return stages.tail(size_); }
  Eigen::Index size() const { return scheme_.stages() * size_; }

 private:
  using Block = std::function<Eigen::MatrixXcd(int, int)>;  ///< of the stages a and b
  void add(Eigen::MatrixXcd& t, const Block& block) const;

  bem::Scheme scheme_;
  int components_;
  Eigen::Index size_;
  std::vector<Eigen::MatrixXcd> initial_;  ///< H_0 by initial component
  std::vector<Eigen::MatrixXd> lags_;      ///< as BodyModel::h
};

}  // namespace bem_test
