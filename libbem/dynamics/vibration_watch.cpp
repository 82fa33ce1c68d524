#include "dynamics/vibration_watch.hpp"

#include "algebra/decompositions.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

namespace bem {
namespace {

constexpr Eigen::Index kSignals = 4, kMostSteps = 512, kFewestSteps = 64, kMostRoots = 16;
constexpr double kLeastGrowth = 0.002;     // during kMostSteps
constexpr double kLeastShare = 0.02;       // of the amplitude of the motion
constexpr double kLargestResidual = 1e-4;  // of the prediction: larger where it is disturbed
constexpr double kFewestPeriods = 2;
constexpr double kLeastMotion = 1e-5;  // about its mean: below is rounding

/// Numbers in [-1/2, 1/2), the same on every machine.
Eigen::MatrixXd signal_weights(Eigen::Index unknowns) {
  std::mt19937 random(1);
  Eigen::MatrixXd out(kSignals, unknowns);
  for (double& w : out.reshaped()) w = random() / 4294967296.0 - 0.5;
  return out;
}

/// Coefficients c of y_n = c_1 y_{n-1} + ... + c_p y_{n-p} + (a constant for each signal); empty if
/// they predict badly. `y`: signals x steps.
Eigen::VectorXd prediction(const Eigen::MatrixXd& y) {
  const Eigen::Index p = std::min(kMostRoots, y.cols() / 4), per_signal = y.cols() - p;
  Eigen::MatrixXd past = Eigen::MatrixXd::Zero(y.rows() * per_signal, p + y.rows());
  Eigen::VectorXd next(past.rows());
  for (Eigen::Index s = 0; s < y.rows(); ++s) {
    const Eigen::Index begin = s * per_signal;
    for (Eigen::Index k = 0; k < p; ++k)
      past.col(k).segment(begin, per_signal) = y.row(s).segment(p - 1 - k, per_signal).transpose();
    past.col(p + s).segment(begin, per_signal).setOnes();
    next.segment(begin, per_signal) = y.row(s).tail(per_signal).transpose();
  }
  constexpr double kDependent = 1e-10;
  const Eigen::VectorXd c = least_squares(past, next, kDependent);
  if (!((past * c - next).norm() <= kLargestResidual * next.norm())) return {};
  return c.head(p);
}

/// z of the motions z^n that follow the prediction.
Eigen::VectorXcd roots(const Eigen::VectorXd& c) {
  const Eigen::Index p = c.size();
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(p, p);
  companion.row(0) = c.transpose();
  companion.diagonal(-1).setOnes();
  return eigenvalues(companion);
}

/// The amplitudes that the motions z^n have at the end, over all signals.
Eigen::VectorXd end_amplitudes(const Eigen::MatrixXd& y, const Eigen::VectorXcd& z) {
  const Eigen::Index steps = y.cols();
  Eigen::MatrixXcd powers(steps, z.size() + 1);
  for (Eigen::Index k = 0; k < z.size(); ++k) {
    // 1 where it is largest
    const Eigen::Index from = std::abs(z[k]) > 1 ? steps - 1 : 0;
    for (Eigen::Index n = 0; n < steps; ++n)
      powers(n, k) = std::pow(z[k], static_cast<double>(n - from));
  }
  powers.rightCols<1>().setOnes();
  const Eigen::MatrixXcd parts = least_squares(powers, y.transpose().cast<std::complex<double>>());
  Eigen::VectorXd out(z.size());
  for (Eigen::Index k = 0; k < z.size(); ++k)
    out[k] = parts.row(k).norm() * std::abs(powers(steps - 1, k)) * (z[k].imag() == 0 ? 1 : 2);
  return out;
}

}  // namespace

VibrationWatch::VibrationWatch() : samples_(Eigen::MatrixXd::Zero(kSignals, kMostSteps)) {}

void VibrationWatch::add(const Eigen::VectorXd& displacement) {
  if (weights_.cols() != displacement.size()) weights_ = signal_weights(displacement.size());
  samples_.col(count_++).noalias() = weights_ * displacement;
  if (count_ == kMostSteps) interrupt();
}

void VibrationWatch::interrupt() {
  const Vibration seen = examined();
  if (seen.growth > found_.growth) found_ = seen;
  count_ = 0;
}

std::optional<Vibration> VibrationWatch::growing() const {
  const Vibration now = examined(), most = now.growth > found_.growth ? now : found_;
  if (most.growth > 1) return most;
  return std::nullopt;
}

/// The fastest growth in what is recorded; growth 1 if there is none.
Vibration VibrationWatch::examined() const {
  Vibration out;
  if (count_ < kFewestSteps) return out;
  const Eigen::MatrixXd all = samples_.leftCols(count_);
  const Eigen::MatrixXd y = all.colwise() - all.rowwise().mean();
  if (!(y.norm() > kLeastMotion * all.norm())) return out;
  const Eigen::VectorXd c = prediction(y);
  if (c.size() == 0) return out;
  const Eigen::VectorXcd z = roots(c);
  const Eigen::VectorXd amplitudes = end_amplitudes(y, z);
  const double whole = y.norm() * std::sqrt(2.0 / static_cast<double>(count_));
  for (Eigen::Index k = 0; k < z.size(); ++k) {
    const double growth = std::abs(z[k]), turns = std::arg(z[k]) / (2 * kPi);
    const bool seen = turns * static_cast<double>(count_) >= kFewestPeriods &&
                      amplitudes[k] >= kLeastShare * whole;
    if (seen && std::log(growth) * kMostSteps > kLeastGrowth && growth > out.growth)
      out = {growth, turns};
  }
  return out;
}

}  // namespace bem
