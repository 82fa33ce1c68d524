#pragma once

#include "model/elastic_system.hpp"
#include "model/traction_response.hpp"

namespace bem {

/// The traction matrices, or those of their columns that belong to some nodes.
struct TractionData {
  std::vector<int> nodes;                                    ///< ascending
  std::shared_ptr<const MatrixFamily> lags;                  ///< G_k, lag >= 1, if there are any
  std::vector<std::shared_ptr<const MatrixFamily>> initial;  ///< H_0^{-1} G_0, iterative: G_0
};

/// Columns of a model whose traction matrices are in memory. Compressed ones are not copied: the
/// model has to outlive the result.
TractionData extract_tractions(const BodyModel& model, const std::vector<int>& nodes);

/// Tractions at some nodes during a step.
struct NodalLoad {
  std::vector<int> nodes;  ///< ascending
  Eigen::MatrixXd stages;  ///< 3 nodes.size() x s [Pa, body axes]
};

class NodalTractions;

/// Past nodal tractions. Few nodes carry any, so every lag keeps its own list.
class NodalHistory {
 public:
  NodalHistory() = default;
  NodalHistory(const Scheme& scheme, int history_length, double window);

  /// Makes `load` that of lag 1; older ones move on by one lag.
  void push(const NodalLoad& load);
  /// `tractions`: whose nodes have carried them all, or null if none has.
  void visit_state(StateArchive& state, const NodalTractions* tractions);
  /// Those that carry any at some lag, ascending.
  std::vector<int> nodes() const;
  /// The window's weight on a lag.
  double factor(int k) const { return std::pow(window_, k); }

  struct Lag {
    std::vector<int> columns;  ///< 3 node + axis
    Eigen::MatrixXd inputs;    ///< columns.size() x components
    void visit_state(StateArchive& state) { state.resizable(columns, inputs); }
  };
  const Lag& lag(int k) const { return ring_[(newest_ + k - 1) % ring_.size()]; }
  int length() const { return static_cast<int>(ring_.size()); }

 private:
  Eigen::MatrixXd right_;  ///< s x components
  double window_ = 1;
  std::vector<Lag> ring_;
  std::size_t newest_ = 0;
};

/// The effect of tractions at single nodes on a body: constraints act through them.
class NodalTractions {
 public:
  NodalTractions(const ElasticSystem& system, TractionData data);

  std::size_t bytes() const;
  /// Whether these unknowns, which ascend, belong to its nodes.
  bool has_columns(const std::vector<int>& columns) const;

  /// component_sums (3N x components) += sum_k G_k p_{n-k}. Reads the columns of loaded nodes.
  void add_history(const NodalHistory& history, Eigen::MatrixXd& component_sums) const;

  /// Adds the effect of nodal tractions of the current step. Reads the columns of loaded nodes.
  void add(const NodalLoad& load, SpectralState& state) const;

  /// Subtracts the balanced value of (a', alpha) under nodal tractions (6 x s).
  void subtract_balance(const NodalLoad& load, Eigen::MatrixXd& accelerations) const;

  /// Displacement without rigid part of some nodes by unit tractions at others, by initial
  /// component: 3 rows.size() x 3 loaded.size() [m/Pa].
  Eigen::MatrixXcd response(int component, const std::vector<int>& rows,
                            const std::vector<int>& loaded) const;
  /// The frame accelerations z of unit tractions (6 x 3 nodes.size()), and the balanced ones.
  Eigen::MatrixXcd acceleration(int component, const std::vector<int>& nodes) const;
  Eigen::MatrixXd balanced_acceleration(const std::vector<int>& nodes) const;

 private:
  void find_accelerations(int component);

  const ElasticSystem& system_;
  std::vector<int> columns_;  ///< unknowns of the nodes, ascending
  std::shared_ptr<const MatrixFamily> lags_;
  std::vector<std::unique_ptr<TractionResponse>> response_;
  /// 6 x 3N, by initial component: z, and the rigid part of the responses that the projection takes
  /// out. Only in the inertial form, whose responses are stored without rigid motion, they differ.
  std::vector<Eigen::MatrixXcd> acceleration_, removed_;
};

/// The unknowns 3*i + axis of some nodes or slots.
std::vector<int> unknowns_of(const std::vector<int>& nodes);

}  // namespace bem
