#include "kernels/lag_product.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
LagProduct::LagProduct(const Scheme& scheme, const LaneLayout& layout,
                       const std::array<double, 3>& p)
    : count_(layout.count()) {
  const std::vector<StageMatrix> series = delta_polynomial(scheme, p);
  /// What the weight `x` of lag k, which is in lane `from`, contributes to the later ones.
  const auto add_later = [&](int k, const StageMatrix& x, int from) {
    for (int j = 0; j < static_cast<int>(series.size()); ++j) {
      if (k + j == 0 || layout.last_lag == 0) continue;
      const StageMatrixC product = (series[j] * x).cast<Complex>();
      const ComponentVectorC components = scheme.extract(product);
      for (int m = 0; m < layout.components; ++m)
        terms_.push_back(
            {layout.lane(std::min(k + j, layout.last_lag), m), from, components[m].real()});
    }
  };
  int lane = 0;
  for (const InitialComponent& c : scheme.initial_components()) {
    const Complex d = c.eigenvalue, value = p[0] + p[1] * d + p[2] * d * d;
    const StageMatrixC part = c.multiplicity() * c.left * c.right.transpose();
    terms_.push_back({lane, lane, value.real()});
    add_later(0, part.real(), lane);
    if (c.paired) {
      terms_.push_back({lane + 1, lane, value.imag()});
      terms_.push_back({lane, lane + 1, -value.imag()});
      terms_.push_back({lane + 1, lane + 1, value.real()});
      add_later(0, -part.imag(), lane + 1);
    }
    lane += c.paired ? 2 : 1;
  }
  for (int k = 1; k <= layout.last_lag; ++k)
    for (int m = 0; m < layout.components; ++m) {
      const LagComponent& c = scheme.lag_components()[m];
      add_later(k, c.left * c.right.transpose(), layout.lane(k, m));
    }
  // one term for every pair of lanes
  std::sort(terms_.begin(), terms_.end(), [](const Term& a, const Term& b) {
    return a.to != b.to ? a.to < b.to : a.from < b.from;
  });
  std::vector<Term> merged;
  for (const Term& t : terms_) {
    if (!merged.empty() && merged.back().to == t.to && merged.back().from == t.from)
      merged.back().factor += t.factor;
    else
      merged.push_back(t);
  }
  terms_ = std::move(merged);
}

}  // namespace bem
