#include "model/nodal_tractions.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <functional>

namespace bem {
std::vector<int> unknowns_of(const std::vector<int>& nodes) {
  std::vector<int> unknowns;
  unknowns.reserve(3 * nodes.size());
  for (int node : nodes)
    for (int axis = 0; axis < 3; ++axis) unknowns.push_back(3 * node + axis);
  return unknowns;
}

TractionData extract_tractions(const BodyModel& model, const std::vector<int>& nodes) {
  const auto& initial = model.is_iterative() ? model.initial_g : model.traction_response;
  require(model.loads != Loads::none && !initial.empty(), "traction matrices are in memory");
  const std::vector<int> columns = unknowns_of(nodes);
  const auto pick = [&](const MatrixFamily& family) -> std::shared_ptr<const MatrixFamily> {
    if (auto smaller = family.pick_columns(columns)) return smaller;
    return {std::shared_ptr<const void>(), &family};
  };
  TractionData data;
  data.nodes = nodes;
  if (model.g) data.lags = pick(*model.g);
  for (const auto& m : initial) data.initial.push_back(pick(*m));
  return data;
}

NodalHistory::NodalHistory(const Scheme& scheme, int history_length, double window)
    : right_(lag_inputs(scheme)), window_(window), ring_(history_length) {}

void NodalHistory::push(const NodalLoad& load) {
  if (ring_.empty()) return;
  newest_ = (newest_ + ring_.size() - 1) % ring_.size();
  Lag& lag = ring_[newest_];
  if (load.stages.isZero(0)) {
    lag = {};
  } else {
    lag.columns = unknowns_of(load.nodes);
    lag.inputs.noalias() = load.stages * right_;
  }
}

std::vector<int> NodalHistory::nodes() const {
  std::vector<int> out;
  for (const Lag& lag : ring_)
    for (std::size_t i = 0; i < lag.columns.size(); i += 3) out.push_back(lag.columns[i] / 3);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

void NodalHistory::visit_state(StateArchive& state, const NodalTractions* tractions) {
  state(ring_, newest_);
  state.check(newest_ < ring_.size() || newest_ == 0);
  for (const Lag& lag : ring_) {
    if (lag.columns.empty()) continue;
    state.check(lag.inputs.rows() == static_cast<Eigen::Index>(lag.columns.size()) &&
                lag.inputs.cols() == right_.cols());
    state.check(tractions && tractions->has_columns(lag.columns));
  }
}

NodalTractions::NodalTractions(const ElasticSystem& system, TractionData data)
    : system_(system), columns_(unknowns_of(data.nodes)), lags_(std::move(data.lags)) {
  for (std::size_t c = 0; c < data.initial.size(); ++c) {
    const InitialSolver& solver = system.solver(static_cast<int>(c));
    response_.push_back(solver.is_iterative() ? solved_response(std::move(data.initial[c]), solver)
                                              : stored_response(std::move(data.initial[c])));
    find_accelerations(static_cast<int>(c));
  }
}

/// Of all columns at once: functionals times the matrix.
void NodalTractions::find_accelerations(int component) {
  const RigidProjection& projection = system_.projection();
  const FrameBalance* balance = system_.frame_balance();
  Eigen::MatrixXcd functionals(projection.rigid().cols(), balance ? 12 : 6);
  functionals.leftCols<6>() = projection.rigid().transpose().cast<Complex>();
  if (balance) functionals.rightCols<6>() = balance->body_force(component);
  const Eigen::MatrixXcd values =
      response_[component]->multiply_transposed(functionals).transpose();
  removed_.push_back(projection.accelerations_of_rigid(component, values.topRows<6>()));
  if (!balance) {
    acceleration_.push_back(removed_.back());
    return;
  }
  const Eigen::MatrixXcd inertia =
      values.bottomRows<6>() -
      balance->body_force(component).transpose() * projection.response(component) * removed_.back();
  acceleration_.push_back(
      balance->accelerations(component, inertia, system_.model().traction_moments[component]));
}

bool NodalTractions::has_columns(const std::vector<int>& columns) const {
  return std::adjacent_find(columns.begin(), columns.end(), std::greater_equal<>()) ==
             columns.end() &&
         std::includes(columns_.begin(), columns_.end(), columns.begin(), columns.end());
}

std::size_t NodalTractions::bytes() const {
  std::size_t sum = lags_ ? lags_->bytes() : 0;
  for (const auto& m : response_) sum += m->bytes();
  return sum;
}

void NodalTractions::add_history(const NodalHistory& history,
                                 Eigen::MatrixXd& component_sums) const {
  if (!lags_) return;
  std::vector<SparseTerm> terms;
  std::vector<double*> outputs;
  const int components = system_.model().components();
  for (int m = 0; m < components; ++m) outputs.push_back(component_sums.col(m).data());
  for (int k = 1; k <= history.length(); ++k) {
    const NodalHistory::Lag& lag = history.lag(k);
    if (lag.columns.empty()) continue;
    for (int m = 0; m < components; ++m)
      terms.push_back({system_.model().lag_index(k, m), &lag.columns, lag.inputs.col(m).data(), m,
                       history.factor(k)});
  }
  lags_->multiply_add(terms, outputs);
}

void NodalTractions::add(const NodalLoad& load, SpectralState& state) const {
  if (load.nodes.empty()) return;
  const std::vector<int> columns = unknowns_of(load.nodes);
  const auto& initial = system_.scheme().initial_components();
  for (std::size_t c = 0; c < initial.size(); ++c) {
    const Eigen::VectorXcd values = load.stages.cast<Complex>() * initial[c].right;
    state.displacement[c] += response_[c]->multiply(columns, values);
    state.displacement[c] -= system_.projection().response(static_cast<int>(c)) *
                             (removed_[c](Eigen::all, columns) * values);
    state.acceleration[c] += acceleration_[c](Eigen::all, columns) * values;
  }
}

void NodalTractions::subtract_balance(const NodalLoad& load, Eigen::MatrixXd& accelerations) const {
  if (!load.nodes.empty())
    accelerations.noalias() -= balanced_acceleration(load.nodes) * load.stages;
}

Eigen::MatrixXcd NodalTractions::response(int component, const std::vector<int>& rows,
                                          const std::vector<int>& loaded) const {
  const std::vector<int> row_unknowns = unknowns_of(rows), columns = unknowns_of(loaded);
  Eigen::MatrixXcd out = response_[component]->block(row_unknowns, columns);
  out.noalias() -= system_.projection().response(component)(row_unknowns, Eigen::all) *
                   removed_[component](Eigen::all, columns);
  return out;
}

Eigen::MatrixXcd NodalTractions::acceleration(int component, const std::vector<int>& nodes) const {
  return acceleration_[component](Eigen::all, unknowns_of(nodes));
}

Eigen::MatrixXd NodalTractions::balanced_acceleration(const std::vector<int>& nodes) const {
  return system_.model().traction_balance(Eigen::all, unknowns_of(nodes));
}

}  // namespace bem
