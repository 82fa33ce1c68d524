#include "assembly/translation_identity.hpp"

namespace bem {
namespace {

StageMatrix zero(const Scheme& scheme) {
  return StageMatrix::Zero(scheme.stages(), scheme.stages());
}

/// Stage matrix of lag k from its lanes.
StageMatrix stage_matrix(const Scheme& scheme, const LaneLayout& layout, const double* lanes,
                         int k) {
  StageMatrix x = zero(scheme);
  if (k == 0) {
    int lane = 0;
    for (const InitialComponent& c : scheme.initial_components()) {
      const Complex value(lanes[lane], c.paired ? lanes[lane + 1] : 0.0);
      x += c.multiplicity() * (value * c.left * c.right.transpose()).real();
      lane += c.paired ? 2 : 1;
    }
    return x;
  }
  for (int m = 0; m < layout.components; ++m) {
    const LagComponent& c = scheme.lag_components()[m];
    x += lanes[layout.lane(k, m)] * c.left * c.right.transpose();
  }
  return x;
}

/// Coefficients of Delta(zeta)^2.
std::vector<StageMatrix> delta_squared(const Scheme& scheme) {
  const std::vector<StageMatrix>& delta = scheme.delta_coefficients();
  std::vector<StageMatrix> square(2 * delta.size() - 1, zero(scheme));
  for (std::size_t i = 0; i < delta.size(); ++i)
    for (std::size_t j = 0; j < delta.size(); ++j) square[i + j] += delta[i] * delta[j];
  return square;
}

}  // namespace

void translation_row_sums(const Scheme& scheme, const LaneLayout& layout, double dt,
                          const double* d, double* row_sums) {
  const int last = layout.last_lag;
  const double scale = -1 / (dt * dt);
  const std::vector<StageMatrix> square = delta_squared(scheme);
  std::vector<StageMatrix> body;
  StageMatrix total = zero(scheme);
  for (int k = 0; k <= last; ++k) {
    body.push_back(stage_matrix(scheme, layout, d, k));
    total += body.back();
  }
  int lane = 0;
  for (const InitialComponent& c : scheme.initial_components()) {
    const Complex value(d[lane], c.paired ? d[lane + 1] : 0.0);
    const Complex sum = scale * c.eigenvalue * c.eigenvalue * value;
    row_sums[lane++] = sum.real();
    if (c.paired) row_sums[lane++] = sum.imag();
  }
  // what is left for the last lag: its own sum and those of all later lags, folded in by the
  // closure
  StageMatrix at_one = zero(scheme);
  for (const StageMatrix& s : square) at_one += s;
  StageMatrix rest = scale * (at_one * total - square[0] * body[0]);
  for (int k = 1; k <= last; ++k) {
    StageMatrix sum = zero(scheme);
    if (k < last) {
      for (int m = 0; m < static_cast<int>(square.size()) && m <= k; ++m)
        sum += scale * square[m] * body[k - m];
      rest -= sum;
    } else {
      sum = rest;
    }
    const ComponentVectorC x = scheme.extract(sum.cast<Complex>());
    for (int m = 0; m < layout.components; ++m) row_sums[layout.lane(k, m)] = x[m].real();
  }
}

}  // namespace bem
