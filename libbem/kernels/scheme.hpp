#pragma once

#include "base/types.hpp"

#include <array>
#include <string>
#include <vector>

namespace bem {

inline constexpr int kMaxStages = 3;
inline constexpr int kMaxComponents = 2 * kMaxStages - 1;

using StageMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxStages, kMaxStages>;
using StageMatrixC =
    Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxStages, kMaxStages>;
using StageVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxStages, 1>;
using StageVectorC = Eigen::Matrix<Complex, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxStages, 1>;
using ComponentVectorC =
    Eigen::Matrix<Complex, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxComponents, 1>;

/// The weight of lag 0 in spectral form: X_0 = sum_i Re(m_i X(lambda_i/dt) left_i right_i^T), where
/// lambda_i are the eigenvalues of Delta(0); m_i = 2 stands for a complex-conjugate pair.
struct InitialComponent {
  Complex eigenvalue;
  StageVectorC left, right;
  bool paired;
  double multiplicity() const { return paired ? 2 : 1; }
};

/// One rank-one component of the weights of the lags k >= 1: X_k = sum_m left_m right_m^T X_k^m
/// with the scalar functions (or matrices) X_k^m.
struct LagComponent {
  StageVector left, right;
};

/// Time discretisation behind the convolution quadrature: a multistep method of the theta family
/// (BDF1 to BDF2) with one stage per step, or the Radau IIA method of two or three stages
/// (docs/method.md, "Time discretisation"). Its weights of a transfer function X(s) are defined by
/// X(Delta(zeta)/dt) = sum_k X_k zeta^k with s x s stage matrices X_k.
///
/// For Radau IIA the s^2 entries of every X_k, k >= 1, are combinations of 2 s - 1 numbers, because
/// Delta depends on zeta through a rank-one matrix. So many components are stored.
class Scheme {
 public:
  /// A name of named_schemes(), or "theta:T" with 0 <= T <= 1 for a multistep method; throws
  /// ErrorCode::usage otherwise.
  static Scheme parse(const std::string& name);
  static Scheme radau2();
  static Scheme radau3();
  /// gamma(zeta) = (1-zeta) + theta/2 (1-zeta)^2: theta = 0 is BDF1, theta = 1 is BDF2.
  static Scheme multistep(double theta);

  const std::string& name() const { return name_; }
  int stages() const { return static_cast<int>(stage_times_.size()); }
  bool is_multistep() const { return stages() == 1; }
  double theta() const { return theta_; }

  /// Stage times in units of dt, after the start of the step; the last one is 1.
  const StageVector& stage_times() const { return stage_times_; }
  /// Stage values of an integral: y = y_base + dt * integration() * y' (Butcher matrix, or
  /// 1/(1 + theta/2) with y_base from the last two steps).
  const StageMatrix& integration() const { return integration_; }

  /// The scheme that weighs the effect of stage b of a step on its stage a with q^(c_a - c_b), c
  /// the stage times: with the factor q per lag the window is q^(t/dt) of the time t between the
  /// two. Only the components change.
  Scheme windowed(double q) const;

  StageMatrixC delta(Complex zeta) const;
  /// Delta(zeta) = sum_m delta_coefficients()[m] zeta^m.
  const std::vector<StageMatrix>& delta_coefficients() const { return delta_; }

  const std::vector<InitialComponent>& initial_components() const { return initial_; }
  const std::vector<LagComponent>& lag_components() const { return components_; }
  /// The component functions X^m of a stage matrix that is a sum of weights of lags k >= 1.
  ComponentVectorC extract(const StageMatrixC& weight) const;

 private:
  void set_initial_components();
  void set_interpolated_components(const std::vector<double>& nodes);

  std::string name_;
  double theta_ = 0;
  StageVector stage_times_;
  StageMatrix integration_;
  std::vector<StageMatrix> delta_;
  std::vector<InitialComponent> initial_;
  std::vector<LagComponent> components_;
  Eigen::MatrixXd extraction_;  ///< components x s^2: extract() of a weight, row after row
};

/// A scheme that a name chooses. To add one: a function that makes it, and its row in scheme.cpp.
struct NamedScheme {
  const char* name;
  Scheme (*make)();
};
/// In the order in which messages list them.
const std::vector<NamedScheme>& named_schemes();
/// What Scheme::parse() takes, as a message says it.
std::string scheme_names();

/// The series of p(Delta(zeta)) in powers of zeta, where p(d) = p[0] + p[1] d + p[2] d^2.
std::vector<StageMatrix> delta_polynomial(const Scheme& scheme, const std::array<double, 3>& p);

/// Number of past steps that are kept by default for lam = r_max/(c2 dt)  (M24):
/// floor(lam+2) + ceil(m sqrt(lam)) with m = 3 for theta > 0.3, 2 for lam > 15, else 1.
int default_history_length(const Scheme& scheme, double lam);

/// Steps that material damping adds to a history: it spreads the arrival of waves, and the response
/// of a point to its own load fades with the retardation time (`time`, in units of dt).
double damped_history_length(double lam, double time);

/// Is a history of n steps of no use for lam? One that is shorter than lam is unstable; matrices of
/// much shorter ones would be of waves that are resolved in a small part of the body only.
inline bool is_too_short(int n, double lam) {
  return lam > 8.0 * (n + 1);
}

/// Smallest n for which the absolute weights of exp(-s r_max/c2) beyond lag n sum to at most
/// `tolerance`.
int history_length_for_tolerance(const Scheme& scheme, double lam, double tolerance);

}  // namespace bem
