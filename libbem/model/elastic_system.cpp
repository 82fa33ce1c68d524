#include "model/elastic_system.hpp"

#include "base/error.hpp"

namespace bem {

ElasticSystem::ElasticSystem(const BodyModel& model, double window)
    : model_(model), window_(window), scheme_(model.discretisation.scheme.windowed(window)) {
  const int initial = static_cast<int>(scheme().initial_components().size());
  std::vector<Eigen::MatrixXcd> response;
  if (model.stiffness) {
    frame_balance_.emplace(model);
    rigid_modes_ = orthonormal_rigid_modes(model.geometry.nodes);
  }
  for (int i = 0; i < initial; ++i) {
    solvers_.push_back(make_initial_solver(model, i));
    response.push_back(frame_balance_ ? frame_balance_->response(i)
                                      : solvers_.back()->solve(model.initial_body_force[i]));
  }
  projection_ = RigidProjection(rigid_part(model.geometry.nodes), std::move(response));
  body_force_.lags = model.body_force;
}

LagHistory ElasticSystem::make_history(Eigen::Index inputs) const {
  return LagHistory(scheme(), inputs, model_.discretisation.history_length, window_);
}

void ElasticSystem::subtract_motion_history(const std::vector<const MotionHistory*>& motions,
                                            std::vector<Eigen::MatrixXd>& component_sums) const {
  if (!model_.h) return;
  const int components = model_.components();
  std::vector<FamilyTerm> terms;
  std::vector<double*> outputs;
  for (std::size_t b = 0; b < motions.size(); ++b) {
    const LagHistory& u = motions[b]->lags();
    for (int m = 0; m < components; ++m) {
      for (int k = 1; k <= u.length(); ++k)
        if (!u.is_zero(k))
          terms.push_back({model_.lag_index(k, m), u.lag(k).col(m).data(),
                           u.coefficients(k).col(m).data(), static_cast<int>(outputs.size()),
                           -u.factor(k)});
      outputs.push_back(component_sums[b].col(m).data());
    }
  }
  model_.h->multiply_add(terms, outputs);
}

/// stage_sums -= D(0) u of the motions without acceleration: stresses alone, without a net force
/// or torque, whatever the codec has made of D(0).
void ElasticSystem::subtract_stiffness(const std::vector<const MotionHistory*>& motions,
                                       std::vector<Eigen::MatrixXd>& stage_sums) const {
  if (!model_.stiffness) return;
  require(motions.size() == stage_sums.size(), "the inertial form knows the past motions");
  const MatrixFamily& family = *model_.stiffness;
  std::vector<Eigen::MatrixXf> coefficients;
  std::vector<Eigen::MatrixXd> forces;
  for (const MotionHistory* motion : motions) {
    const Eigen::MatrixXd& u = motion->unaccelerated();
    coefficients.emplace_back(static_cast<Eigen::Index>(family.coefficients()), u.cols());
    family.analyse_columns(u, coefficients.back());
    forces.push_back(Eigen::MatrixXd::Zero(u.rows(), u.cols()));
  }
  std::vector<FamilyTerm> terms;
  std::vector<double*> outputs;
  for (std::size_t b = 0; b < motions.size(); ++b)
    for (Eigen::Index a = 0; a < forces[b].cols(); ++a) {
      terms.push_back({0, motions[b]->unaccelerated().col(a).data(), coefficients[b].col(a).data(),
                       static_cast<int>(outputs.size()), 1});
      outputs.push_back(forces[b].col(a).data());
    }
  family.multiply_add(terms, outputs);
  for (std::size_t b = 0; b < motions.size(); ++b)
    stage_sums[b] -= forces[b] - rigid_modes_ * (rigid_modes_.transpose() * forces[b]);
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
    const std::vector<const MotionHistory*>& motions,
    const std::vector<SolutionMemory*>& memories) const {
  const auto bodies = static_cast<Eigen::Index>(component_sums.size());
  std::vector<Eigen::MatrixXd> stage_sums;
  for (const Eigen::MatrixXd& sums : component_sums) {
    stage_sums.push_back(Eigen::MatrixXd::Zero(sums.rows(), scheme().stages()));
    for (int m = 0; m < model_.components(); ++m)
      stage_sums.back().noalias() += sums.col(m) * scheme().lag_components()[m].left.transpose();
  }
  subtract_stiffness(motions, stage_sums);
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
    const Eigen::MatrixXcd z = remove_rigid(component, loads, u);
    for (Eigen::Index b = 0; b < bodies; ++b) {
      states[b].displacement.push_back(u.col(b));
      states[b].acceleration.push_back(z.col(b));
    }
  }
  if (model_.stiffness) add_unaccelerated(motions, states);
  return states;
}

/// Takes the rigid motion out of the solutions u of right-hand sides b; returns z (6 x n).
Eigen::MatrixXcd ElasticSystem::remove_rigid(int component, const Eigen::MatrixXcd& b,
                                             Eigen::MatrixXcd& u) const {
  if (!frame_balance_) return projection_.project(component, u);
  Eigen::MatrixXcd z(6, u.cols());
  for (Eigen::Index c = 0; c < u.cols(); ++c) {  // each column on its own: same bits always
    projection_.project(component, u.col(c));
    const Eigen::MatrixXcd inertia = frame_balance_->body_force(component).transpose() * u.col(c);
    const Eigen::MatrixXcd load = b.col(c);
    z.col(c) = frame_balance_->accelerations(component, inertia, frame_balance_->moments(load));
  }
  return z;
}

void ElasticSystem::add_unaccelerated(const std::vector<const MotionHistory*>& motions,
                                      std::vector<SpectralState>& states) const {
  for (std::size_t b = 0; b < motions.size(); ++b)
    for (std::size_t i = 0; i < states[b].displacement.size(); ++i)
      states[b].displacement[i] +=
          motions[b]->unaccelerated().cast<Complex>() * scheme().initial_components()[i].right;
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

void ElasticSystem::subtract_balance(const InputColumns& columns, const Eigen::MatrixXd& stages,
                                     Eigen::MatrixXd& accelerations) const {
  accelerations.noalias() -= columns.balanced_acceleration * stages;
}

Eigen::MatrixXd ElasticSystem::without_rounding(const Eigen::MatrixXd& displacements) const {
  if (!frame_balance_) return displacements;
  return displacements - frame_balance_->rigid_motions() * (projection_.rigid() * displacements);
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
    columns.acceleration.push_back(remove_rigid(static_cast<int>(i), initial[i], u));
    columns.displacement.push_back(std::move(u));
  }
  return columns;
}

}  // namespace bem
