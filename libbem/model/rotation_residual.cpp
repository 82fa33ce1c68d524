#include "model/rotation_residual.hpp"

#include <algorithm>

namespace bem {

RotationResidual::RotationResidual(const BodyModel& model, MatrixForm form)
    : model_(model), form_(form) {
  const auto n = static_cast<Eigen::Index>(model.nodes());
  turns_.resize(3 * n, 3);
  for (Eigen::Index i = 0; i < n; ++i)
    turns_.middleRows<3>(3 * i) = cross_matrix(model.geometry.nodes.vertices[i]).transpose();
  moved_ = Eigen::MatrixXcd::Zero(3 * n, 3);
}

template <class T>
void RotationResidual::add(const MatrixSlab<T>& slab) {
  const bool symmetric = form_ == MatrixForm::symmetric;
  const InitialComponent& c = model_.discretisation.scheme.initial_components()[0];
  const Eigen::Index first = 3 * slab.first, rows = 3 * (slab.last - slab.first);
  const Eigen::Index columns = symmetric ? turns_.rows() - first : turns_.rows();
  const Eigen::Index beyond = symmetric ? columns - rows : 0;
  const auto apply = [&](const Eigen::MatrixXd& part, auto moved) {
    moved.middleRows(first, rows) += part.rightCols(columns) * turns_.bottomRows(columns);
    moved.bottomRows(beyond) += part.rightCols(beyond).transpose() * turns_.middleRows(first, rows);
  };
  apply(slab.initial_h[0], moved_.real());
  if (c.paired) apply(slab.initial_h[1], moved_.imag());
  size_ = std::max(size_, slab.initial_h[0].rightCols(columns).cwiseAbs().maxCoeff());
  known_.emplace_back(first, rows);
}

double RotationResidual::value() const {
  const InitialComponent& c = model_.discretisation.scheme.initial_components()[0];
  const Complex s = c.eigenvalue / model_.discretisation.dt;
  double largest = 0;
  for (const auto& [first, rows] : known_)
    largest = std::max(largest, (moved_.middleRows(first, rows) +
                                 s * s * model_.initial_body_force[0].block(first, 3, rows, 3))
                                    .cwiseAbs()
                                    .maxCoeff());
  const double size = model_.discretisation.is_galerkin() ? size_ : 1;
  return largest / (size * model_.geometry.extent);
}

template void RotationResidual::add(const MatrixSlab<float>& slab);
template void RotationResidual::add(const MatrixSlab<double>& slab);

}  // namespace bem
