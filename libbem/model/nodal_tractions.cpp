#include "model/nodal_tractions.hpp"

#include "base/error.hpp"
#include "compress/dense_family.hpp"

#include <algorithm>
#include <numeric>

namespace bem {
namespace {

/// Some columns of an uncompressed family, in the precision of the model.
template <class T>
std::shared_ptr<const MatrixFamily> pick_columns(const MatrixFamily& family,
                                                 const std::vector<int>& columns) {
  std::vector<int> rows(family.rows());
  std::iota(rows.begin(), rows.end(), 0);
  auto out = std::make_shared<ColumnFamily<T>>(family.rows(), columns, family.count());
  for (int k = 0; k < family.count(); ++k) {
    const Eigen::MatrixXd entries = family.block(k, rows, columns);
    std::transform(entries.data(), entries.data() + entries.size(), out->matrix(k).column(0),
                   [](double x) { return static_cast<T>(x); });
  }
  return out;
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
  require(model.g && !model.traction_response.empty(), "traction matrices are in memory");
  const std::vector<int> columns = unknowns_of(nodes);
  const auto pick = [&](const MatrixFamily& family) -> std::shared_ptr<const MatrixFamily> {
    if (dynamic_cast<const DenseFamily<float>*>(&family))
      return pick_columns<float>(family, columns);
    if (dynamic_cast<const DenseFamily<double>*>(&family))
      return pick_columns<double>(family, columns);
    return {std::shared_ptr<const void>(), &family};
  };
  TractionData data;
  data.nodes = nodes;
  data.lags = pick(*model.g);
  for (const auto& m : model.traction_response) data.response.push_back(pick(*m));
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
    lag.columns = unknowns_of(load.nodes);
    lag.inputs.noalias() = load.stages * right_;
  }
}

NodalTractions::NodalTractions(const ElasticSystem& system, TractionData data)
    : system_(system), data_(std::move(data)) {
  // z of all columns at once: the projection's functional times the matrix
  const RigidProjection& projection = system.projection();
  const Eigen::MatrixXd functional = projection.rigid().transpose();
  for (std::size_t c = 0; c < data_.response.size(); ++c) {
    const MatrixFamily& m = *data_.response[c];
    Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(m.columns()),
                                                  functional.cols() * m.count());
    std::vector<FamilyTerm> terms;
    std::vector<double*> outputs;
    for (int k = 0; k < m.count(); ++k)
      for (Eigen::Index i = 0; i < functional.cols(); ++i) {
        terms.push_back({k, functional.col(i).data(), nullptr, static_cast<int>(outputs.size())});
        outputs.push_back(rigid.col(static_cast<Eigen::Index>(outputs.size())).data());
      }
    m.multiply_transposed_add(terms, outputs);
    Eigen::MatrixXcd moved = rigid.leftCols(6).transpose().cast<Complex>();
    if (m.count() > 1) moved.imag() = rigid.rightCols(6).transpose();
    acceleration_.push_back(projection.accelerations_of_rigid(static_cast<int>(c), moved));
  }
}

std::size_t NodalTractions::bytes() const {
  std::size_t sum = data_.lags->bytes();
  for (const auto& m : data_.response) sum += m->bytes();
  return sum;
}

void NodalTractions::add_history(const NodalHistory& history,
                                 Eigen::MatrixXd& component_sums) const {
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
  data_.lags->multiply_add(terms, outputs);
}

void NodalTractions::add(const NodalLoad& load, SpectralState& state) const {
  if (load.nodes.empty()) return;
  const std::vector<int> columns = unknowns_of(load.nodes);
  const auto& initial = system_.scheme().initial_components();
  const Eigen::Index n = state.displacement[0].size();
  for (std::size_t c = 0; c < initial.size(); ++c) {
    const Eigen::VectorXcd values = load.stages.cast<Complex>() * initial[c].right;
    const Eigen::VectorXd real = values.real(), imaginary = values.imag();
    const MatrixFamily& m = *data_.response[c];
    Eigen::VectorXd u_real = Eigen::VectorXd::Zero(n), u_imaginary = Eigen::VectorXd::Zero(n);
    std::vector<SparseTerm> terms = {{0, &columns, real.data(), 0}};
    if (m.count() > 1) {
      terms.push_back({0, &columns, imaginary.data(), 1});
      terms.push_back({1, &columns, imaginary.data(), 0, -1.0});
      terms.push_back({1, &columns, real.data(), 1});
    }
    m.multiply_add(terms, {u_real.data(), u_imaginary.data()});
    const Eigen::VectorXcd z = acceleration_[c](Eigen::all, columns) * values;
    state.displacement[c].real() += u_real;
    state.displacement[c].imag() += u_imaginary;
    state.displacement[c] -= system_.projection().response(static_cast<int>(c)) * z;
    state.acceleration[c] += z;
  }
}

void NodalTractions::subtract_balance(const NodalLoad& load, Eigen::MatrixXd& accelerations) const {
  if (!load.nodes.empty())
    accelerations.noalias() -= balanced_acceleration(load.nodes) * load.stages;
}

Eigen::MatrixXcd NodalTractions::response(int component, const std::vector<int>& rows,
                                          const std::vector<int>& loaded) const {
  const std::vector<int> row_unknowns = unknowns_of(rows), columns = unknowns_of(loaded);
  const MatrixFamily& m = *data_.response[component];
  Eigen::MatrixXcd out = m.block(0, row_unknowns, columns).cast<Complex>();
  if (m.count() > 1) out.imag() = m.block(1, row_unknowns, columns);
  out.noalias() -= system_.projection().response(component)(row_unknowns, Eigen::all) *
                   acceleration_[component](Eigen::all, columns);
  return out;
}

Eigen::MatrixXcd NodalTractions::acceleration(int component, const std::vector<int>& nodes) const {
  return acceleration_[component](Eigen::all, unknowns_of(nodes));
}

Eigen::MatrixXd NodalTractions::balanced_acceleration(const std::vector<int>& nodes) const {
  return system_.model().traction_balance(Eigen::all, unknowns_of(nodes));
}

}  // namespace bem
