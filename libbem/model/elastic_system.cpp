#include "model/elastic_system.hpp"

#include "base/error.hpp"

namespace bem {

Eigen::MatrixXd lag_inputs(const Scheme& scheme) {
  const auto& components = scheme.lag_components();
  Eigen::MatrixXd right(scheme.stages(), static_cast<Eigen::Index>(components.size()));
  for (Eigen::Index m = 0; m < right.cols(); ++m) right.col(m) = components[m].right;
  return right;
}

LagHistory::LagHistory(const Scheme& scheme, Eigen::Index inputs, int history_length, double window,
                       const MatrixFamily* family)
    : right_(lag_inputs(scheme)),
      window_(window),
      family_(family),
      ring_(history_length, Eigen::MatrixXd::Zero(inputs, right_.cols())),
      coefficients_(
          history_length,
          Eigen::MatrixXf::Zero(family ? static_cast<Eigen::Index>(family->coefficients()) : 0,
                                right_.cols())),
      zero_(history_length, 1) {}

void LagHistory::push(const Eigen::MatrixXd& stages) {
  if (ring_.empty()) return;
  newest_ = (newest_ + ring_.size() - 1) % ring_.size();
  ring_[newest_].noalias() = stages * right_;
  zero_[newest_] = stages.isZero(0);
  if (family_) family_->analyse_columns(ring_[newest_], coefficients_[newest_]);
}

void LagHistory::visit_state(StateArchive& state) {
  state(ring_, zero_, newest_);
  state.check(newest_ < ring_.size() || newest_ == 0);
  if (!state.restores() || !family_) return;
  for (std::size_t i = 0; i < ring_.size(); ++i)
    if (!zero_[i]) family_->analyse_columns(ring_[i], coefficients_[i]);
}

ElasticSystem::ElasticSystem(const BodyModel& model, double window)
    : model_(model), window_(window), scheme_(model.discretisation.scheme.windowed(window)) {
  const int initial = static_cast<int>(scheme().initial_components().size());
  std::vector<Eigen::MatrixXcd> response;
  for (int i = 0; i < initial; ++i) {
    solvers_.push_back(make_initial_solver(model, i));
    response.push_back(solvers_.back()->solve(model.initial_body_force[i]));
  }
  projection_ = RigidProjection(rigid_part(model.geometry.nodes), std::move(response));
  body_force_.lags = model.body_force;
}

LagHistory ElasticSystem::make_history(Eigen::Index inputs) const {
  return LagHistory(scheme(), inputs, model_.discretisation.history_length, window_);
}

LagHistory ElasticSystem::make_displacement_history() const {
  return LagHistory(scheme(), static_cast<Eigen::Index>(3 * model_.nodes()),
                    model_.discretisation.history_length, window_, model_.h.get());
}

void ElasticSystem::subtract_displacement_history(
    const std::vector<const LagHistory*>& u, std::vector<Eigen::MatrixXd>& component_sums) const {
  if (!model_.h) return;
  const int components = model_.components();
  std::vector<FamilyTerm> terms;
  std::vector<double*> outputs;
  for (std::size_t b = 0; b < u.size(); ++b)
    for (int m = 0; m < components; ++m) {
      for (int k = 1; k <= u[b]->length(); ++k)
        if (!u[b]->is_zero(k))
          terms.push_back({model_.lag_index(k, m), u[b]->lag(k).col(m).data(),
                           u[b]->coefficients(k).col(m).data(), static_cast<int>(outputs.size()),
                           -u[b]->factor(k)});
      outputs.push_back(component_sums[b].col(m).data());
    }
  model_.h->multiply_add(terms, outputs);
}

void ElasticSystem::add_input_history(const InputColumns& columns, const LagHistory& inputs,
                                      Eigen::MatrixXd& component_sums) const {
  for (int k = 1; k <= inputs.length(); ++k) {
    if (inputs.is_zero(k)) continue;
    for (int m = 0; m < model_.components(); ++m)
      component_sums.col(m).noalias() +=
          columns.lags[model_.lag_index(k, m)] * (inputs.factor(k) * inputs.lag(k).col(m));
  }
}

bool SolutionMemory::fits(std::size_t components, Eigen::Index unknowns) const {
  for (const std::deque<Pair>& pairs : pairs_)
    for (const Pair& p : pairs)
      if (p.u.size() != unknowns || p.b.size() != unknowns) return false;
  return pairs_.size() <= components;
}

Eigen::VectorXcd SolutionMemory::guess(int component, const Eigen::VectorXcd& b) const {
  Eigen::VectorXcd u = Eigen::VectorXcd::Zero(b.size());
  if (component < static_cast<int>(pairs_.size()))
    for (const Pair& p : pairs_[component]) u += p.b.dot(b) * p.u;
  return u;
}

void SolutionMemory::add(int component, Eigen::VectorXcd u, Eigen::VectorXcd b) {
  constexpr std::size_t kMost = 40;
  constexpr double kNew = 1e-4;  // of b: less is known already
  if (component >= static_cast<int>(pairs_.size())) pairs_.resize(component + 1);
  std::deque<Pair>& pairs = pairs_[component];
  const double size = b.norm();
  for (const Pair& p : pairs) {
    const Complex part = p.b.dot(b);
    b -= part * p.b;
    u -= part * p.u;
  }
  const double rest = b.norm();
  if (!(rest > kNew * size)) return;
  if (pairs.size() == kMost) pairs.pop_front();
  pairs.push_back({u / rest, b / rest});
}

std::vector<SpectralState> ElasticSystem::solve(
    const std::vector<Eigen::MatrixXd>& component_sums,
    const std::vector<SolutionMemory*>& memories) const {
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
    const int component = static_cast<int>(i);
    if (loads.isZero(0)) {  // nothing has happened yet, or the model has no history
      for (SpectralState& state : states) {
        state.displacement.push_back(Eigen::VectorXcd::Zero(loads.rows()));
        state.acceleration.push_back(Eigen::VectorXcd::Zero(6));
      }
      continue;
    }
    Eigen::MatrixXcd guess(loads.rows(), static_cast<Eigen::Index>(memories.size()));
    for (Eigen::Index b = 0; b < guess.cols(); ++b)
      guess.col(b) = memories[b]->guess(component, loads.col(b));
    Eigen::MatrixXcd u = solvers_[i]->solve(loads, guess);
    for (Eigen::Index b = 0; b < guess.cols(); ++b)
      memories[b]->add(component, u.col(b), loads.col(b));
    const Eigen::MatrixXcd z = projection_.project(component, u);
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
    Eigen::MatrixXcd u = solvers_[i]->solve(initial[i]);
    columns.acceleration.push_back(projection_.project(static_cast<int>(i), u));
    columns.displacement.push_back(std::move(u));
  }
  return columns;
}

}  // namespace bem
