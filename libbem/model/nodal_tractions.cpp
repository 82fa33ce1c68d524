#include "model/nodal_tractions.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"

#include <algorithm>

namespace bem {
namespace {

template <class T>
std::unique_ptr<StoredMatrix> column_store(const Eigen::MatrixXd& columns) {
  auto store = std::make_unique<ColumnStore<T>>(columns.rows(), columns.cols());
  std::transform(columns.data(), columns.data() + columns.size(), store->column(0),
                 [](double x) { return static_cast<T>(x); });
  return store;
}

}  // namespace

std::vector<int> unknowns_of(const std::vector<int>& nodes) {
  std::vector<int> unknowns;
  unknowns.reserve(3 * nodes.size());
  for (int node : nodes)
    for (int axis = 0; axis < 3; ++axis) unknowns.push_back(3 * node + axis);
  return unknowns;
}

TractionData extract_tractions(const BodyModel& model, const std::vector<int>& nodes) {
  require(!model.g.empty() && !model.traction_response.empty(), "traction matrices are in memory");
  const std::vector<int> unknowns = unknowns_of(nodes);
  const auto pick = [&](const StoredMatrix& m) {
    const Eigen::MatrixXd columns = m.extract_columns(unknowns);
    return model.precision == Precision::float32 ? column_store<float>(columns)
                                                 : column_store<double>(columns);
  };
  TractionData data;
  data.nodes = nodes;
  for (const auto& g : model.g) data.lags.push_back(pick(*g));
  for (const SpectralMatrix& m : model.traction_response) {
    SpectralMatrix picked;
    picked.real = pick(*m.real);
    if (m.imaginary) picked.imaginary = pick(*m.imaginary);
    data.response.push_back(std::move(picked));
  }
  return data;
}

NodalHistory::NodalHistory(const Scheme& scheme, int history_length, double window)
    : right_(lag_inputs(scheme)), window_(window), ring_(history_length) {}

void NodalHistory::push(const NodalLoad& load) {
  newest_ = (newest_ + ring_.size() - 1) % ring_.size();
  Lag& lag = ring_[newest_];
  if (load.stages.isZero(0)) {
    lag = {};
  } else {
    lag.columns = unknowns_of(load.slots);
    lag.inputs.noalias() = load.stages * right_;
  }
  if (window_ != 1)
    for (Lag& l : ring_) l.inputs *= window_;
}

NodalTractions::NodalTractions(const ElasticSystem& system, TractionData data)
    : system_(system), data_(std::move(data)), slot_of_node_(system.model().nodes(), -1) {
  const std::vector<int>& nodes = data_.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) slot_of_node_[nodes[i]] = static_cast<int>(i);
  balanced_ = system.model().traction_balance(Eigen::all, unknowns_of(nodes));
  const auto columns = static_cast<Eigen::Index>(3 * nodes.size());
  for (std::size_t c = 0; c < data_.response.size(); ++c) {
    const SpectralMatrix& m = data_.response[c];
    Eigen::MatrixXcd z(6, columns);
    parallel_for(nodes.size(), [&](std::size_t i) {
      const std::vector<int> unknowns = unknowns_of({static_cast<int>(i)});
      Eigen::MatrixXcd v = m.real->extract_columns(unknowns).cast<Complex>();
      if (m.imaginary) v.imag() = m.imaginary->extract_columns(unknowns);
      z.middleCols<3>(static_cast<Eigen::Index>(3 * i)) =
          system.projection().accelerations(static_cast<int>(c), v);
    });
    acceleration_.push_back(std::move(z));
  }
}

int NodalTractions::slot(int node) const {
  const int slot = slot_of_node_[node];
  require(slot >= 0, "the traction columns of the node are loaded");
  return slot;
}

std::size_t NodalTractions::bytes() const {
  std::size_t sum = 0;
  for (const auto& m : data_.lags) sum += m->bytes();
  for (const SpectralMatrix& m : data_.response)
    sum += m.real->bytes() + (m.imaginary ? m.imaginary->bytes() : 0);
  return sum;
}

void NodalTractions::add_history(const NodalHistory& history,
                                 Eigen::MatrixXd& component_sums) const {
  for (int k = 1; k <= history.length(); ++k) {
    const NodalHistory::Lag& lag = history.lag(k);
    if (lag.columns.empty()) continue;
    for (int m = 0; m < system_.model().components(); ++m)
      data_.lags[system_.model().lag_index(k, m)]->multiply_add_columns(
          lag.columns, lag.inputs.col(m).data(), component_sums.col(m).data());
  }
}

void NodalTractions::add(const NodalLoad& load, SpectralState& state) const {
  if (load.slots.empty()) return;
  const std::vector<int> columns = unknowns_of(load.slots);
  const auto& initial = system_.scheme().initial_components();
  const Eigen::Index n = state.displacement[0].size();
  for (std::size_t c = 0; c < initial.size(); ++c) {
    const Eigen::VectorXcd values = load.stages.cast<Complex>() * initial[c].right;
    const Eigen::VectorXd real = values.real(), imaginary = values.imag();
    const SpectralMatrix& m = data_.response[c];
    Eigen::VectorXd u_real = Eigen::VectorXd::Zero(n), u_imaginary = Eigen::VectorXd::Zero(n);
    m.real->multiply_add_columns(columns, real.data(), u_real.data());
    if (m.imaginary) {
      const Eigen::VectorXd negative = -imaginary;
      m.imaginary->multiply_add_columns(columns, negative.data(), u_real.data());
      m.real->multiply_add_columns(columns, imaginary.data(), u_imaginary.data());
      m.imaginary->multiply_add_columns(columns, real.data(), u_imaginary.data());
    }
    const Eigen::VectorXcd z = acceleration_[c](Eigen::all, columns) * values;
    state.displacement[c].real() += u_real;
    state.displacement[c].imag() += u_imaginary;
    state.displacement[c] -= system_.projection().response(static_cast<int>(c)) * z;
    state.acceleration[c] += z;
  }
}

void NodalTractions::subtract_balance(const NodalLoad& load, Eigen::MatrixXd& accelerations) const {
  if (!load.slots.empty())
    accelerations.noalias() -= balanced_acceleration(load.slots) * load.stages;
}

Eigen::MatrixXcd NodalTractions::response(int component, const std::vector<int>& rows,
                                          const std::vector<int>& slots) const {
  const std::vector<int> row_unknowns = unknowns_of(rows), columns = unknowns_of(slots);
  const SpectralMatrix& m = data_.response[component];
  Eigen::MatrixXcd out = m.real->extract_block(row_unknowns, columns).cast<Complex>();
  if (m.imaginary) out.imag() = m.imaginary->extract_block(row_unknowns, columns);
  out.noalias() -= system_.projection().response(component)(row_unknowns, Eigen::all) *
                   acceleration_[component](Eigen::all, columns);
  return out;
}

Eigen::MatrixXcd NodalTractions::acceleration(int component, const std::vector<int>& slots) const {
  return acceleration_[component](Eigen::all, unknowns_of(slots));
}

Eigen::MatrixXd NodalTractions::balanced_acceleration(const std::vector<int>& slots) const {
  return balanced_(Eigen::all, unknowns_of(slots));
}

}  // namespace bem
