#include "kernels/contour.hpp"

#include "algebra/decompositions.hpp"
#include "base/error.hpp"

#include <cmath>

#include <fftw3.h>

namespace bem {
namespace {

constexpr double kAliasing = 1e-14;

template <class T>
struct FftwDelete {
  void operator()(T* p) const { fftw_free(p); }
};
using FftwReal = std::unique_ptr<double[], FftwDelete<double>>;
using FftwComplex = std::unique_ptr<fftw_complex[], FftwDelete<fftw_complex>>;

}  // namespace

LaneLayout::LaneLayout(const Scheme& scheme, int last) : initial(0), last_lag(last) {
  for (const InitialComponent& c : scheme.initial_components()) initial += c.paired ? 2 : 1;
  components = static_cast<int>(scheme.lag_components().size());
}

std::vector<double> static_lane_factors(const Scheme& scheme, const LaneLayout& layout) {
  // all stages see the same constant input; the last stage is the new value
  const int last_stage = scheme.stages() - 1;
  std::vector<double> factors;
  for (const InitialComponent& c : scheme.initial_components()) {
    const Complex f = c.multiplicity() * c.left[last_stage] * c.right.sum();
    factors.push_back(f.real());
    if (c.paired) factors.push_back(-f.imag());
  }
  for (int k = 1; k <= layout.last_lag; ++k)
    for (const LagComponent& c : scheme.lag_components())
      factors.push_back(c.left[last_stage] * c.right.sum());
  return factors;
}

Eigen::MatrixXd static_columns(const Scheme& scheme, const LaneLayout& layout,
                               const std::vector<Eigen::MatrixXcd>& initial,
                               const std::vector<Eigen::MatrixXd>& lags) {
  const std::vector<double> factors = static_lane_factors(scheme, layout);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(initial.at(0).rows(), initial[0].cols());
  for (std::size_t i = 0, lane = 0; i < initial.size(); ++i) {
    sum += factors[lane++] * initial[i].real();
    if (scheme.initial_components()[i].paired) sum += factors[lane++] * initial[i].imag();
  }
  for (std::size_t k = 0; k < lags.size(); ++k) sum += factors[layout.initial + k] * lags[k];
  return sum;
}

struct ContourQuadrature::Transform {
  explicit Transform(int length) : n(length) {
    const FftwComplex in(fftw_alloc_complex(n / 2 + 1));
    const FftwReal out(fftw_alloc_real(n));
    plan = fftw_plan_dft_c2r_1d(n, in.get(), out.get(), FFTW_ESTIMATE);
    require(plan != nullptr, "FFTW can plan the transform");
  }
  ~Transform() { fftw_destroy_plan(plan); }
  int n;
  fftw_plan plan;
};

ContourQuadrature::ContourQuadrature(const Scheme& scheme, int last_lag)
    : scheme_(scheme),
      layout_(scheme, last_lag),
      length_(4 * (last_lag + 1)),
      radius_(std::pow(kAliasing, 0.5 / length_)) {
  require(last_lag >= (scheme.is_multistep() ? 0 : 1), "a past step is kept");
  for (int l = 0; l <= length_ / 2; ++l)
    points_.push_back(spectral_point(std::polar(radius_, 2 * kPi * l / length_)));
  at_zero_ = spectral_point(0);
  at_one_ = spectral_point(1);
  transform_ = std::make_unique<Transform>(length_);
}

ContourQuadrature::~ContourQuadrature() = default;

ContourQuadrature::Point ContourQuadrature::spectral_point(Complex zeta) const {
  const Eigensystem spectrum = eigensystem(scheme_.delta(zeta));
  const StageMatrixC vectors = spectrum.vectors, inverse = bem::inverse(spectrum.vectors);
  Point p;
  p.eigenvalues = spectrum.values;
  for (int e = 0; e < scheme_.stages(); ++e) {
    // a root at zeta = 1 may come out with a real part of -1e-17
    if (p.eigenvalues[e].real() < 0) p.eigenvalues[e].real(0);
    p.components.push_back(scheme_.extract(vectors.col(e) * inverse.row(e)));
  }
  return p;
}

void ContourQuadrature::weights(int count, const TransferFunctions& functions, double* out,
                                bool closed) const {
  const int half = length_ / 2 + 1;
  const int components = layout_.components;
  std::vector<Complex> value(count);

  for (int i = 0, lane = 0; i < static_cast<int>(scheme_.initial_components().size()); ++i) {
    const InitialComponent& c = scheme_.initial_components()[i];
    functions(c.eigenvalue, value.data());
    for (int f = 0; f < count; ++f) {
      out[f * layout_.count() + lane] = value[f].real();
      if (c.paired) out[f * layout_.count() + lane + 1] = value[f].imag();
    }
    lane += c.paired ? 2 : 1;
  }

  // samples[f][m][l], conjugated because FFTW's c2r transform has the exponent +i
  std::vector<Complex> samples(static_cast<std::size_t>(count) * components * half, 0.0);
  for (int l = 0; l < half; ++l) {
    const Point& p = points_[l];
    for (int e = 0; e < scheme_.stages(); ++e) {
      functions(p.eigenvalues[e], value.data());
      for (int f = 0; f < count; ++f)
        for (int m = 0; m < components; ++m)
          samples[(f * components + m) * half + l] += std::conj(value[f] * p.components[e][m]);
    }
  }
  const FftwComplex in(fftw_alloc_complex(half));
  const FftwReal series(fftw_alloc_real(length_));
  for (int f = 0; f < count; ++f)
    for (int m = 0; m < components; ++m) {
      const Complex* s = &samples[(f * components + m) * half];
      for (int l = 0; l < half; ++l) {
        in[l][0] = s[l].real();
        in[l][1] = s[l].imag();
      }
      fftw_execute_dft_c2r(transform_->plan, in.get(), series.get());
      for (int k = 1; k <= layout_.last_lag; ++k)
        out[f * layout_.count() + layout_.lane(k, m)] = std::pow(radius_, -k) / length_ * series[k];
    }
  if (closed) add_closure(count, functions, out);
}

void ContourQuadrature::add_closure(int count, const TransferFunctions& functions,
                                    double* out) const {
  const int components = layout_.components;
  std::vector<Complex> value(count);
  std::vector<Complex> total(static_cast<std::size_t>(count) * components, 0.0);
  const auto accumulate = [&](const Point& p, double sign) {
    for (int e = 0; e < scheme_.stages(); ++e) {
      functions(p.eigenvalues[e], value.data());
      for (int f = 0; f < count; ++f)
        for (int m = 0; m < components; ++m)
          total[f * components + m] += sign * value[f] * p.components[e][m];
    }
  };
  accumulate(at_one_, 1);
  accumulate(at_zero_, -1);
  for (int f = 0; f < count; ++f)
    for (int m = 0; m < components; ++m) {
      double* weight = out + f * layout_.count();
      double kept = 0;
      for (int k = 1; k <= layout_.last_lag; ++k) kept += weight[layout_.lane(k, m)];
      weight[layout_.lane(layout_.last_lag, m)] += total[f * components + m].real() - kept;
    }
}

}  // namespace bem
