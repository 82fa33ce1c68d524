#include "kernels/scheme.hpp"

#include "algebra/decompositions.hpp"
#include "base/error.hpp"
#include "kernels/contour.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

namespace bem {
namespace {

constexpr std::string_view kThetaPrefix = "theta:";

}  // namespace

Scheme Scheme::radau2() {
  Scheme s;
  s.name_ = "radau2";
  s.stage_times_.resize(2);
  s.stage_times_ << 1.0 / 3, 1.0;
  s.integration_.resize(2, 2);
  s.integration_ << 5.0 / 12, -1.0 / 12, 3.0 / 4, 1.0 / 4;
  // Delta(zeta) = A^{-1} (1 - zeta [[0,1],[0,1]])
  StageMatrix constant(2, 2), linear(2, 2);
  constant << 1.5, 0.5, -4.5, 2.5;
  linear << 0, -2, 0, 2;
  s.delta_ = {constant, linear};
  // X22 = X11 - X21/3 - X12 for every lag k >= 1; components X12, X22, X11 - X12 (extract()).
  const auto component = [](double l1, double l2, double r1, double r2) {
    LagComponent c;
    c.left.resize(2);
    c.right.resize(2);
    c.left << l1, l2;
    c.right << r1, r2;
    return c;
  };
  s.components_ = {component(1, 0, 1, 1), component(0, 1, -3, 1), component(1, 3, 1, 0)};
  s.extraction_.resize(3, 4);
  s.extraction_ << 0, 1, 0, 0, 0, 0, 0, 1, 1, -1, 0, 0;
  s.set_initial_components();
  return s;
}

Scheme Scheme::radau3() {
  const double r = std::sqrt(6.0);
  Scheme s;
  s.name_ = "radau3";
  s.stage_times_.resize(3);
  s.stage_times_ << (4 - r) / 10, (4 + r) / 10, 1.0;
  s.integration_.resize(3, 3);
  s.integration_ << (88 - 7 * r) / 360, (296 - 169 * r) / 1800, (-2 + 3 * r) / 225,
      (296 + 169 * r) / 1800, (88 + 7 * r) / 360, (-2 - 3 * r) / 225, (16 - r) / 36, (16 + r) / 36,
      1.0 / 9;
  const StageMatrix inverse = bem::inverse(s.integration_);
  StageMatrix last = StageMatrix::Zero(3, 3);
  last.col(2).setOnes();
  s.delta_ = {inverse, -inverse * last};
  // nodes with well-conditioned components (3.4)
  s.set_interpolated_components({std::numeric_limits<double>::infinity(), -5, -1, 3, 9});
  s.set_initial_components();
  return s;
}

/// Components of a Runge-Kutta method. A weight is a contour integral over z of l(z) r(z)^T times a
/// scalar, l = (z - A^{-1})^{-1} A^{-1} 1 and r^T = e_s^T (z - A^{-1})^{-1} but for a common
/// denominator, which makes them polynomials of degree s - 1. Their product is interpolated at
/// 2 s - 1 nodes.
void Scheme::set_interpolated_components(const std::vector<double>& nodes) {
  const StageMatrix inverse = bem::inverse(integration_);
  const StageMatrix one = StageMatrix::Identity(stages(), stages());
  const StageVector start = inverse * StageVector::Ones(stages());
  Eigen::MatrixXd products(stages() * stages(), static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t m = 0; m < nodes.size(); ++m) {
    LagComponent c{start, one.col(stages() - 1)};  // at infinity
    if (std::isfinite(nodes[m])) {
      const StageMatrix resolvent = bem::inverse(nodes[m] * one - inverse);
      c = {resolvent * start, resolvent.row(stages() - 1).transpose()};
    }
    c.left.normalize();
    c.right.normalize();
    for (int a = 0; a < stages(); ++a)
      products.col(static_cast<Eigen::Index>(m)).segment(a * stages(), stages()) =
          c.left[a] * c.right;
    components_.push_back(c);
  }
  extraction_ = pseudo_inverse(products);
}

Scheme Scheme::multistep(double theta) {
  require(theta >= 0 && theta <= 1, "0 <= theta <= 1");
  Scheme s;
  s.theta_ = theta;
  if (theta == 0) {
    s.name_ = "bdf1";
  } else if (theta == 1) {
    s.name_ = "bdf2";
  } else {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, theta).ptr;
    s.name_ = std::string(kThetaPrefix) + std::string(digits, end);
  }
  const auto scalar = [](double value) { return StageMatrix::Constant(1, 1, value); };
  s.stage_times_ = StageVector::Ones(1);
  s.integration_ = scalar(1 / (1 + theta / 2));
  s.delta_ = {scalar(1 + theta / 2), scalar(-1 - theta), scalar(theta / 2)};
  s.components_ = {{StageVector::Ones(1), StageVector::Ones(1)}};
  s.extraction_ = Eigen::MatrixXd::Ones(1, 1);
  s.set_initial_components();
  return s;
}

Scheme Scheme::parse(const std::string& name) {
  for (const NamedScheme& s : named_schemes())
    if (name == s.name) return s.make();
  if (name.rfind(kThetaPrefix, 0) == 0) {
    double theta = -1;
    const char* end = name.data() + name.size();
    const auto result = std::from_chars(name.data() + kThetaPrefix.size(), end, theta);
    if (result.ec == std::errc() && result.ptr == end && theta >= 0 && theta <= 1)
      return multistep(theta);
  }
  throw Error(ErrorCode::usage,
              "unknown time discretisation \"" + name + "\"; use " + scheme_names());
}

Scheme Scheme::windowed(double q) const {
  require(q > 0 && q <= 1, "0 < q <= 1");
  Scheme s = *this;
  for (int a = 0; a < stages(); ++a) {
    const double factor = std::pow(q, stage_times_[a] - 1);
    for (InitialComponent& c : s.initial_) {
      c.left[a] *= factor;
      c.right[a] /= factor;
    }
    for (LagComponent& c : s.components_) {
      c.left[a] *= factor;
      c.right[a] /= factor;
    }
  }
  return s;
}

StageMatrixC Scheme::delta(Complex zeta) const {
  StageMatrixC sum = delta_.back().cast<Complex>();
  for (int m = static_cast<int>(delta_.size()) - 2; m >= 0; --m)
    sum = (sum * zeta + delta_[m].cast<Complex>()).eval();
  return sum;
}

void Scheme::set_initial_components() {
  const Eigensystem spectrum = eigensystem(delta(0));
  const Eigen::MatrixXcd inverse = bem::inverse(spectrum.vectors);
  for (int i = 0; i < stages(); ++i) {
    const Complex value = spectrum.values[i];
    const bool real = std::abs(value.imag()) < 1e-12 * std::abs(value);
    if (!real && value.imag() < 0) continue;  // stands for its conjugate
    InitialComponent c;
    c.eigenvalue = real ? Complex(value.real()) : value;
    c.left = spectrum.vectors.col(i);
    c.right = inverse.row(i).transpose();
    c.paired = !real;
    initial_.push_back(c);
  }
}

ComponentVectorC Scheme::extract(const StageMatrixC& w) const {
  ComponentVectorC x = ComponentVectorC::Zero(extraction_.rows());
  for (Eigen::Index a = 0; a < w.rows(); ++a)
    for (Eigen::Index b = 0; b < w.cols(); ++b)
      for (Eigen::Index m = 0; m < x.size(); ++m)
        x[m] += extraction_(m, a * w.cols() + b) * w(a, b);
  return x;
}

std::vector<StageMatrix> delta_polynomial(const Scheme& scheme, const std::array<double, 3>& p) {
  const std::vector<StageMatrix>& delta = scheme.delta_coefficients();
  const int s = scheme.stages();
  std::vector<StageMatrix> series(2 * delta.size() - 1, StageMatrix::Zero(s, s));
  series[0] += p[0] * StageMatrix::Identity(s, s);
  for (std::size_t i = 0; i < delta.size(); ++i) {
    series[i] += p[1] * delta[i];
    for (std::size_t j = 0; j < delta.size(); ++j) series[i + j] += p[2] * delta[i] * delta[j];
  }
  return series;
}

int default_history_length(const Scheme& scheme, double lam) {
  const double margin = scheme.theta() > 0.3 ? 3 : (lam > 15 ? 2 : 1);
  return static_cast<int>(std::floor(lam + 2) + std::ceil(margin * std::sqrt(lam)));
}

double damped_history_length(double lam, double time) {
  constexpr double kDeviations = 3, kTimes = 5;
  return std::ceil(kDeviations * std::sqrt(lam * time) + kTimes * time);
}

int history_length_for_tolerance(const Scheme& scheme, double lam, double tolerance) {
  require(tolerance > 0, "history tolerance is positive");
  const int longest = static_cast<int>(std::ceil(3 * lam + 12 * std::sqrt(lam) + 20));
  const LaneLayout lanes(scheme, longest);
  const ContourQuadrature contour(scheme, longest);
  std::vector<double> weights(lanes.count());
  contour.weights(
      1, [lam](Complex d, Complex* value) { *value = std::exp(-d * lam); }, weights.data());
  double tail = 0;
  for (int k = longest; k >= 1; --k) {
    for (int m = 0; m < lanes.components; ++m) tail += std::abs(weights[lanes.lane(k, m)]);
    if (tail > tolerance) return k;
  }
  return 1;
}

const std::vector<NamedScheme>& named_schemes() {
  static const std::vector<NamedScheme> schemes = {{"radau2", Scheme::radau2},
                                                   {"radau3", Scheme::radau3},
                                                   {"bdf1", [] { return Scheme::multistep(0); }},
                                                   {"bdf2", [] { return Scheme::multistep(1); }}};
  return schemes;
}

std::string scheme_names() {
  std::string out;
  for (const NamedScheme& s : named_schemes())
    out += (out.empty() ? "" : ", ") + std::string(s.name);
  return out + " or " + std::string(kThetaPrefix) + "T with 0 <= T <= 1";
}

}  // namespace bem
