#pragma once

#include "model/body_model.hpp"

#include <cmath>

namespace bem_test {

/// Amplification factor per step of the scheme for y' = (w/dt) y: the root near e^w of
/// Delta(1/z) = w for the multistep methods, R(w) = (1 + w/3)/(1 - 2w/3 + w^2/6) for Radau IIA.
inline bem::Complex amplification(const bem::Scheme& scheme, bem::Complex w) {
  if (scheme.stages() == 2) return (1.0 + w / 3.0) / (1.0 - 2.0 / 3 * w + w * w / 6.0);
  // (1 - zeta) + theta/2 (1 - zeta)^2 = w with zeta = 1/z
  const double theta = scheme.theta();
  return 1.0 / (1.0 - 2.0 * w / (1.0 + std::sqrt(1.0 + 2 * theta * w)));
}

/// The inverse: w/dt is the frequency of the discretised body that a free motion with the factor z
/// per step belongs to; the eigenvalue of Delta(1/z) nearest to log z.
inline bem::Complex frequency_of(const bem::Scheme& scheme, bem::Complex z) {
  const Eigen::ComplexEigenSolver<bem::StageMatrixC> solver(scheme.delta(1.0 / z), false);
  bem::Complex best = solver.eigenvalues()[0];
  for (Eigen::Index i = 1; i < solver.eigenvalues().size(); ++i) {
    const bem::Complex w = solver.eigenvalues()[i];
    if (std::abs(w - std::log(z)) < std::abs(best - std::log(z))) best = w;
  }
  return best;
}

/// T(z) = sum_k H_k z^{-k} of the free motions u_n = z^n v of a body in a stationary frame, from
/// the matrices that a model stores. Unknowns: 3N of the first stage, then 3N of the second.
class FreeRecursion {
 public:
  explicit FreeRecursion(const bem::BodyModel& model)
      : scheme_(model.discretisation.scheme),
        components_(model.components()),
        size_(static_cast<Eigen::Index>(3 * model.nodes())) {
    for (const auto& m : model.inverse) {
      Eigen::MatrixXcd inverse = full_matrix(*m, 0).cast<bem::Complex>();
      if (m->count() > 1) inverse.imag() = full_matrix(*m, 1);
      initial_.push_back(inverse.inverse());
    }
    for (int i = 0; i < model.h->count(); ++i)
      lags_.push_back(std::pow(model.window, i / components_ + 1) * full_matrix(*model.h, i));
  }

  Eigen::MatrixXcd operator()(bem::Complex z) const {
    const int s = scheme_.stages();
    Eigen::MatrixXcd t = Eigen::MatrixXcd::Zero(s * size_, s * size_);
    for (std::size_t i = 0; i < initial_.size(); ++i) {
      const bem::InitialComponent& c = scheme_.initial_components()[i];
      add(t, [&](int a, int b) -> Eigen::MatrixXcd {
        const bem::Complex factor = c.multiplicity() * c.left[a] * c.right[b];
        return (factor * initial_[i]).real().cast<bem::Complex>();
      });
    }
    for (int m = 0; m < components_; ++m) {
      Eigen::MatrixXcd sum = Eigen::MatrixXcd::Zero(size_, size_);
      bem::Complex power = 1;
      for (std::size_t k = m; k < lags_.size(); k += components_) {
        power /= z;
        sum += power * lags_[k];
      }
      const bem::LagComponent& c = scheme_.lag_components()[m];
      add(t, [&](int a, int b) -> Eigen::MatrixXcd { return c.left[a] * c.right[b] * sum; });
    }
    return t;
  }

  const bem::Scheme& scheme() const { return scheme_; }
  /// Displacements at the end of the step, the last stage, of a vector of all stages.
  Eigen::VectorXcd displacement(const Eigen::VectorXcd& stages) const { return stages.tail(size_); }
  Eigen::Index size() const { return scheme_.stages() * size_; }

 private:
  template <class F>
  void add(Eigen::MatrixXcd& t, const F& block) const {
    for (int a = 0; a < scheme_.stages(); ++a)
      for (int b = 0; b < scheme_.stages(); ++b)
        t.block(a * size_, b * size_, size_, size_) += block(a, b);
  }

  bem::Scheme scheme_;
  int components_;
  Eigen::Index size_;
  std::vector<Eigen::MatrixXcd> initial_;  ///< H_0 by initial component
  std::vector<Eigen::MatrixXd> lags_;      ///< as BodyModel::h
};

}  // namespace bem_test
