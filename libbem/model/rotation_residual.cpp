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
  const auto own = turns_.middleRows(first, rows);
  const auto apply = [&](const Eigen::MatrixXd& part, auto moved) {
    for (int node = symmetric ? slab.first : 0; node < static_cast<int>(model_.nodes()); ++node) {
      if (!slab.h_columns.holds(node)) continue;
      const auto columns = part.middleCols<3>(3 * slab.h_columns.place[node]);
      moved.middleRows(first, rows) += columns * turns_.middleRows<3>(3 * node);
      if (symmetric && node >= slab.last)
        moved.template middleRows<3>(3 * node) += columns.transpose() * own;
      size_ = std::max(size_, columns.cwiseAbs().maxCoeff());
    }
  };
  const auto apply_factors = [&](const FarBlock& b, const FactoredMatrices& factors,
                                 std::size_t which, auto moved) {
    if (which >= factors.inputs.size()) return;
    const Eigen::MatrixXd outputs = factors.outputs.cast<double>(),
                          inputs = factors.inputs[which].cast<double>();
    const Eigen::Index row = 3 * b.rows.begin, column = 3 * b.columns.begin;
    moved.middleRows(row, outputs.rows()) +=
        outputs * (inputs * turns_.middleRows(column, inputs.cols()));
    moved.middleRows(column, inputs.cols()) +=
        inputs.transpose() * (outputs.transpose() * turns_.middleRows(row, outputs.rows()));
  };
  apply(slab.initial_h[0], moved_.real());
  if (c.paired) apply(slab.initial_h[1], moved_.imag());
  for (const FarBlock& b : slab.far) {
    apply_factors(b, b.stiffness, 0, moved_.real());
    apply_factors(b, b.inertia, 0, moved_.real());
    if (c.paired) apply_factors(b, b.inertia, 1, moved_.imag());
  }
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
