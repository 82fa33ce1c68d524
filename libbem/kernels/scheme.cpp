#include "kernels/scheme.hpp"

#include "base/error.hpp"
#include "kernels/contour.hpp"

#include <charconv>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace bem {

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
  s.set_initial_components();
  return s;
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
    s.name_ = "theta:" + std::string(digits, end);
  }
  const auto scalar = [](double value) { return StageMatrix::Constant(1, 1, value); };
  s.stage_times_ = StageVector::Ones(1);
  s.integration_ = scalar(1 / (1 + theta / 2));
  s.delta_ = {scalar(1 + theta / 2), scalar(-1 - theta), scalar(theta / 2)};
  s.components_ = {{StageVector::Ones(1), StageVector::Ones(1)}};
  s.set_initial_components();
  return s;
}

Scheme Scheme::parse(const std::string& name) {
  if (name == "radau2") return radau2();
  if (name == "bdf1") return multistep(0);
  if (name == "bdf2") return multistep(1);
  if (name.rfind("theta:", 0) == 0) {
    double theta = -1;
    const char* end = name.data() + name.size();
    const auto result = std::from_chars(name.data() + 6, end, theta);
    if (result.ec == std::errc() && result.ptr == end && theta >= 0 && theta <= 1)
      return multistep(theta);
  }
  throw Error(ErrorCode::usage, "unknown time discretisation \"" + name +
                                    "\"; use radau2, bdf1, bdf2 or theta:T with 0 <= T <= 1");
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
  const Eigen::ComplexEigenSolver<StageMatrixC> solver(delta(0));
  const StageMatrixC vectors = solver.eigenvectors();
  const StageMatrixC inverse = vectors.inverse();
  for (int i = 0; i < stages(); ++i) {
    const Complex value = solver.eigenvalues()[i];
    const bool real = std::abs(value.imag()) < 1e-12 * std::abs(value);
    if (!real && value.imag() < 0) continue;  // stands for its conjugate
    InitialComponent c;
    c.eigenvalue = real ? Complex(value.real()) : value;
    c.left = vectors.col(i);
    c.right = inverse.row(i).transpose();
    c.paired = !real;
    initial_.push_back(c);
  }
}

StageVectorC Scheme::extract(const StageMatrixC& w) const {
  StageVectorC x(static_cast<int>(components_.size()));
  if (stages() == 1)
    x << w(0, 0);
  else
    x << w(0, 1), w(1, 1), w(0, 0) - w(0, 1);
  return x;
}

int default_history_length(const Scheme& scheme, double lam) {
  const double margin = scheme.theta() > 0.3 ? 3 : (lam > 15 ? 2 : 1);
  return static_cast<int>(std::floor(lam + 2) + std::ceil(margin * std::sqrt(lam)));
}

int damped_history_length(double lam, double time) {
  constexpr double kDeviations = 3, kTimes = 5;
  return static_cast<int>(std::ceil(kDeviations * std::sqrt(lam * time) + kTimes * time));
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

}  // namespace bem
