#pragma once

#include "base/state_archive.hpp"
#include "compress/matrix_family.hpp"
#include "kernels/scheme.hpp"

#include <cmath>

namespace bem {

/// What turns the stage values of an input into its component inputs: s x components.
Eigen::MatrixXd lag_inputs(const Scheme& scheme);

/// Past values of some scalar inputs (displacements, accelerations, loads), kept as the component
/// inputs right_m . (stage values) that the lag matrices multiply.
class LagHistory {
 public:
  LagHistory() = default;
  /// `family`: what the inputs are multiplied by, if that is compressed; must outlive this.
  LagHistory(const Scheme& scheme, Eigen::Index inputs, int history_length, double window,
             const MatrixFamily* family = nullptr);

  /// Makes `stages` (inputs x s) the values of lag 1; older ones move on by one lag.
  void push(const Eigen::MatrixXd& stages);
  void visit_state(StateArchive& state);

  /// Component inputs of a lag (inputs x components), 1 <= lag <= history_length.
  const Eigen::MatrixXd& lag(int k) const { return ring_[slot(k)]; }
  /// What MatrixFamily::analyse says of them: coefficients x components.
  const Eigen::MatrixXf& coefficients(int k) const { return coefficients_[slot(k)]; }
  /// The window's weight on a lag.
  double factor(int k) const { return std::pow(window_, k); }
  /// Whether all values of a lag are zero, so that its matrices need not be read.
  bool is_zero(int k) const { return zero_[slot(k)]; }
  /// Whether those of all lags are.
  bool is_zero() const;
  int length() const { return static_cast<int>(ring_.size()); }

 private:
  std::size_t slot(int k) const { return (newest_ + k - 1) % ring_.size(); }

  Eigen::MatrixXd right_;  ///< s x components
  double window_ = 1;
  const MatrixFamily* family_ = nullptr;
  std::vector<Eigen::MatrixXd> ring_;
  std::vector<Eigen::MatrixXf> coefficients_;
  std::vector<char> zero_;
  std::size_t newest_ = 0;
};

}  // namespace bem
