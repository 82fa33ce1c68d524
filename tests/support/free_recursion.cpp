#include "support/free_recursion.hpp"

#include "algebra/decompositions.hpp"

#include <cmath>

namespace bem_test {

bem::Complex amplification(const bem::Scheme& scheme, bem::Complex w) {
  if (scheme.stages() == 2) return (1.0 + w / 3.0) / (1.0 - 2.0 / 3 * w + w * w / 6.0);
  // (1 - zeta) + theta/2 (1 - zeta)^2 = w with zeta = 1/z
  const double theta = scheme.theta();
  return 1.0 / (1.0 - 2.0 * w / (1.0 + std::sqrt(1.0 + 2 * theta * w)));
}

bem::Complex frequency_of(const bem::Scheme& scheme, bem::Complex z) {
  const Eigen::VectorXcd values = bem::eigenvalues(scheme.delta(1.0 / z));
  bem::Complex best = values[0];
  for (const bem::Complex& w : values)
    if (std::abs(w - std::log(z)) < std::abs(best - std::log(z))) best = w;
  return best;
}

FreeRecursion::FreeRecursion(const bem::BodyModel& model)
    : scheme_(model.discretisation.scheme),
      components_(model.components()),
      size_(static_cast<Eigen::Index>(3 * model.nodes())) {
  for (const auto& m : model.inverse) {
    Eigen::MatrixXcd inverse = full_matrix(*m, 0).cast<bem::Complex>();
    if (m->count() > 1) inverse.imag() = full_matrix(*m, 1);
    initial_.push_back(bem::inverse(inverse));
  }
  for (int i = 0; i < model.h->count(); ++i)
    lags_.push_back(std::pow(model.window, i / components_ + 1) * full_matrix(*model.h, i));
}

void FreeRecursion::add(Eigen::MatrixXcd& t, const Block& block) const {
  for (int a = 0; a < scheme_.stages(); ++a)
    for (int b = 0; b < scheme_.stages(); ++b)
      t.block(a * size_, b * size_, size_, size_) += block(a, b);
}

Eigen::MatrixXcd FreeRecursion::operator()(bem::Complex z) const {
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

}  // namespace bem_test
