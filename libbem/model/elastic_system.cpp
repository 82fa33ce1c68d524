#include "model/elastic_system.hpp"

#include "base/error.hpp"

namespace bem {

Eigen::MatrixXd lag_inputs(const Scheme& scheme) {
  const auto& components = scheme.lag_components();
  Eigen::MatrixXd right(scheme.stages(), static_cast<Eigen::Index>(components.size()));
  for (Eigen::Index m = 0; m < right.cols(); ++m) right.col(m) = components[m].right;
  return right;
}

LagHistory::LagHistory(const Scheme& scheme, Eigen::Index inputs, int history_length, double window)
    : right_(lag_inputs(scheme)),
      window_(window),
      ring_(history_length, Eigen::MatrixXd::Zero(inputs, right_.cols())),
      zero_(history_length, 1) {}

void LagHistory::push(const Eigen::MatrixXd& stages) {
  newest_ = (newest_ + ring_.size() - 1) % ring_.size();
  ring_[newest_].noalias() = stages * right_;
  zero_[newest_] = stages.isZero(0);
  if (window_ != 1)
    for (Eigen::MatrixXd& values : ring_) values *= window_;
}

ElasticSystem::ElasticSystem(const BodyModel& model, double window)
    : model_(model), window_(window), scheme_(model.discretisation.scheme.windowed(window)) {
  const int initial = static_cast<int>(scheme().initial_components().size());
  std::vector<Eigen::MatrixXcd> response;
  for (int i = 0; i < initial; ++i)
    response.push_back(apply_inverse(i, model.initial_body_force[i]));
  projection_ = RigidProjection(rigid_part(model.geometry.nodes), std::move(response));
  body_force_.lags = model.body_force;
}

LagHistory ElasticSystem::make_history(Eigen::Index inputs) const {
  return LagHistory(scheme(), inputs, model_.discretisation.history_length, window_);
}

void ElasticSystem::subtract_displacement_history(
    const std::vector<const LagHistory*>& u, std::vector<Eigen::MatrixXd>& component_sums) const {
  const Eigen::Index n = component_sums[0].rows();
  const int components = model_.components();
  Eigen::MatrixXd inputs(n, static_cast<Eigen::Index>(u.size()));
  Eigen::MatrixXd product(n, inputs.cols());
  for (int k = 1; k <= u[0]->length(); ++k) {
    std::vector<Eigen::Index> moving;  // bodies with anything to multiply at this lag
    for (std::size_t b = 0; b < u.size(); ++b)
      if (!u[b]->is_zero(k)) moving.push_back(static_cast<Eigen::Index>(b));
    const auto count = static_cast<Eigen::Index>(moving.size());
    for (int m = 0; m < components && count > 0; ++m) {
      for (Eigen::Index c = 0; c < count; ++c) inputs.col(c) = u[moving[c]]->lag(k).col(m);
      product.setZero();
      model_.h[model_.lag_index(k, m)]->multiply_add(inputs.data(), product.data(),
                                                     static_cast<int>(count));
      for (Eigen::Index c = 0; c < count; ++c) component_sums[moving[c]].col(m) -= product.col(c);
    }
  }
}

void ElasticSystem::add_input_history(const InputColumns& columns, const LagHistory& inputs,
                                      Eigen::MatrixXd& component_sums) const {
  for (int k = 1; k <= inputs.length(); ++k) {
    if (inputs.is_zero(k)) continue;
    for (int m = 0; m < model_.components(); ++m)
      component_sums.col(m).noalias() +=
          columns.lags[model_.lag_index(k, m)] * inputs.lag(k).col(m);
  }
}

Eigen::MatrixXcd ElasticSystem::apply_inverse(int component, const Eigen::MatrixXcd& v) const {
  const SpectralMatrix& inverse = model_.inverse[component];
  const Eigen::Index n = v.rows(), count = v.cols();
  // real and imaginary parts of the vectors side by side: each matrix is read once
  Eigen::MatrixXd parts(n, 2 * count);
  parts << v.real(), v.imag();
  const int vectors = static_cast<int>(inverse.imaginary ? 2 * count : count);
  Eigen::MatrixXd by_real = Eigen::MatrixXd::Zero(n, 2 * count);
  inverse.real->multiply_add(parts.data(), by_real.data(), vectors);
  Eigen::MatrixXcd out(n, count);
  if (!inverse.imaginary) {
    out = by_real.leftCols(count).cast<Complex>();
    return out;
  }
  Eigen::MatrixXd by_imaginary = Eigen::MatrixXd::Zero(n, 2 * count);
  inverse.imaginary->multiply_add(parts.data(), by_imaginary.data(), vectors);
  out.real() = by_real.leftCols(count) - by_imaginary.rightCols(count);
  out.imag() = by_real.rightCols(count) + by_imaginary.leftCols(count);
  return out;
}

std::vector<SpectralState> ElasticSystem::solve(
    const std::vector<Eigen::MatrixXd>& component_sums) const {
  const auto bodies = static_cast<Eigen::Index>(component_sums.size());
  std::vector<Eigen::MatrixXd> stage_sums;
  for (const Eigen::MatrixXd& sums : component_sums) {
    stage_sums.push_back(Eigen::MatrixXd::Zero(sums.rows(), scheme().stages()));
    for (int m = 0; m < model_.components(); ++m)
      stage_sums.back().noalias() += sums.col(m) * scheme().lag_components()[m].left.transpose();
  }
  std::vector<SpectralState> states(component_sums.size());
  for (std::size_t i = 0; i < scheme().initial_components().size(); ++i) {
    const InitialComponent& c = scheme().initial_components()[i];
    Eigen::MatrixXcd loads(stage_sums[0].rows(), bodies);
    for (Eigen::Index b = 0; b < bodies; ++b)
      loads.col(b) = stage_sums[b].cast<Complex>() * c.right;
    Eigen::MatrixXcd u = apply_inverse(static_cast<int>(i), loads);
    const Eigen::MatrixXcd z = projection_.project(static_cast<int>(i), u);
    for (Eigen::Index b = 0; b < bodies; ++b) {
      states[b].displacement.push_back(u.col(b));
      states[b].acceleration.push_back(z.col(b));
    }
  }
  return states;
}

void ElasticSystem::add_inputs(const InputColumns& columns, const Eigen::MatrixXd& stages,
                               SpectralState& state) const {
  for (std::size_t i = 0; i < state.displacement.size(); ++i) {
    const Eigen::VectorXcd values = stages.cast<Complex>() * scheme().initial_components()[i].right;
    state.displacement[i].noalias() += columns.displacement[i] * values;
    state.acceleration[i].noalias() += columns.acceleration[i] * values;
  }
}

Eigen::MatrixXd ElasticSystem::stages(const std::vector<Eigen::VectorXcd>& spectral) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(spectral[0].size(), scheme().stages());
  for (std::size_t i = 0; i < spectral.size(); ++i) {
    const InitialComponent& c = scheme().initial_components()[i];
    for (int a = 0; a < scheme().stages(); ++a)
      out.col(a) += c.multiplicity() * (c.left[a] * spectral[i]).real();
  }
  return out;
}

Eigen::MatrixXd ElasticSystem::displacement_stages(const SpectralState& state) const {
  return stages(state.displacement);
}

Eigen::MatrixXd ElasticSystem::acceleration_stages(const SpectralState& state) const {
  return -stages(state.acceleration);
}

InputColumns ElasticSystem::make_columns(std::vector<Eigen::MatrixXd> lags,
                                         const std::vector<Eigen::MatrixXcd>& initial) const {
  const Scheme& unwindowed = model_.discretisation.scheme;
  const LaneLayout layout(unwindowed, model_.discretisation.history_length);
  InputColumns columns;
  columns.balanced_acceleration =
      model_.balance * static_columns(unwindowed, layout, initial, lags);
  columns.lags = std::move(lags);
  for (std::size_t i = 0; i < initial.size(); ++i) {
    Eigen::MatrixXcd u = apply_inverse(static_cast<int>(i), initial[i]);
    columns.acceleration.push_back(projection_.project(static_cast<int>(i), u));
    columns.displacement.push_back(std::move(u));
  }
  return columns;
}

}  // namespace bem
