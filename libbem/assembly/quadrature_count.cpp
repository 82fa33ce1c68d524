#include "assembly/quadrature_count.hpp"

#include "assembly/pair_integrals.hpp"
#include "assembly/panel_quadrature.hpp"
#include "base/interruption.hpp"
#include "base/parallel.hpp"

#include <algorithm>
#include <numeric>

namespace bem {
namespace {

constexpr std::size_t kSamples = 32, kCrookedest = 8;
constexpr std::size_t kMostPoints = 500000;  // of one triangle: beyond that the least is said

QuadratureCount operator*(double factor, const QuadratureCount& c) {
  return {factor * c.near_points, factor * c.static_points};
}

void operator+=(QuadratureCount& sum, const QuadratureCount& c) {
  sum.near_points += c.near_points;
  sum.static_points += c.static_points;
}

/// Of the points of one triangle with all triangles.
QuadratureCount count_of_pairs(const PairQuadrature& quadrature, int tx) {
  double dynamic_points = 0, static_points = 0;
  const int count = static_cast<int>(quadrature.mesh().triangles.size());
  const auto add = [&](int ty, KernelPart part, double& sum) {
    if (sum < kMostPoints)
      sum += static_cast<double>(quadrature.near_point_count(tx, ty, part, kMostPoints));
  };
  for (int ty = 0; ty < count; ++ty) {
    check_interruption();
    add(ty, KernelPart::dynamic_part, dynamic_points);
    add(ty, KernelPart::static_part, static_points);
  }
  return {dynamic_points, static_points};
}

/// Of one triangle as it is seen from all vertices.
QuadratureCount count_of_panel(const PanelQuadrature& quadrature, int triangle) {
  QuadratureCount out;
  PointBatch batch;
  const int vertices = static_cast<int>(quadrature.mesh().vertices.size());
  for (int v = 0; v < vertices; ++v)
    quadrature.for_each_batch(v, triangle, batch, [&](const PointBatch& b) {
      if (!b.far) out.near_points += b.size;
    });
  return out;
}

/// The sum over all triangles of what `count` gives for one.
template <class Count>
QuadratureCount sampled_sum(const TriangleMesh& mesh, const Count& count) {
  std::vector<double> ratios;
  for (const Triangle& t : mesh.triangles) ratios.push_back(height_ratio(mesh, t));
  std::vector<int> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return ratios[a] < ratios[b]; });
  const std::size_t crooked = std::min(kCrookedest, order.size()), others = order.size() - crooked,
                    some = std::min(kSamples - kCrookedest, others);
  std::vector<QuadratureCount> counts(crooked + some);
  parallel_for(counts.size(), [&](std::size_t i) {
    if (i < crooked) {
      counts[i] = count(order[i]);
    } else {
      const std::size_t at = crooked + (2 * (i - crooked) + 1) * others / (2 * some);
      counts[i] = (static_cast<double>(others) / static_cast<double>(some)) * count(order[at]);
    }
  });
  QuadratureCount sum;
  for (const QuadratureCount& c : counts) sum += c;
  return sum;
}

}  // namespace

QuadratureCount count_quadrature(const TriangleMesh& mesh, const Discretisation& d) {
  if (d.is_galerkin()) {
    const PairIntegrals pairs(mesh, d);
    return sampled_sum(mesh, [&](int t) { return count_of_pairs(pairs.quadrature(), t); });
  }
  const PanelQuadrature panels(mesh, d.quadrature_tolerance, largest_wave_number(d));
  return sampled_sum(mesh, [&](int t) { return count_of_panel(panels, t); });
}

}  // namespace bem
