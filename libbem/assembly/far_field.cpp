#include "assembly/far_field.hpp"

#include <algorithm>
#include <numeric>

namespace bem {

FarField::FarField(const TriangleMesh& mesh, const EdgeReconstruction& reconstruction,
                   const PairIntegrals& pairs, const GalerkinCombination& combination,
                   const LaneLayout& layout)
    : mesh_(mesh),
      pairs_(pairs),
      combination_(combination),
      layout_(layout),
      surface_(mesh, reconstruction) {
  for (const Vec3& x : mesh.vertices) radius_ = std::max(radius_, x.norm());
  const int count = layout.count();
  initial_of_inertia_.resize(layout.initial, count);
  g_of_adjoint_.resize(count, count);
  g_of_static_.resize(count);
  std::vector<double> unit(count, 0.0), lanes(count);
  combination.g(1.0, unit.data(), g_of_static_.data());
  for (int lane = 0; lane < count; ++lane) {
    unit[lane] = 1;
    combination.initial_h(0.0, unit.data(), lanes.data());
    for (int i = 0; i < layout.initial; ++i) initial_of_inertia_(i, lane) = lanes[i];
    combination.g(0.0, unit.data(), g_of_adjoint_.col(lane).data());
    unit[lane] = 0;
  }
}

bool FarField::holds(const NodeRange& rows, const NodeRange& columns) const {
  constexpr int kGroup = 16;  // nodes
  const auto suffices = [&](const ClusterExtent& x, const ClusterExtent& y) {
    const double apart = distance(x.box, y.box), edge = std::max(x.longest_edge, y.longest_edge);
    const PairQuadrature& quadrature = pairs_.quadrature();
    return quadrature.midpoints_suffice(apart, edge, KernelPart::dynamic_part) &&
           quadrature.midpoints_suffice(apart, edge, KernelPart::static_part);
  };
  const auto groups = [&](const NodeRange& nodes, int most) {
    std::vector<ClusterExtent> out;
    for (int begin = nodes.begin; begin < nodes.end; begin += most)
      out.emplace_back(surface_, begin, std::min(nodes.end, begin + most));
    return out;
  };
  const std::vector<ClusterExtent> x_groups = groups(rows, kGroup),
                                   y_groups = groups(columns, kGroup);
  for (std::size_t i = 0; i < x_groups.size(); ++i)
    for (std::size_t k = 0; k < y_groups.size(); ++k) {
      if (suffices(x_groups[i], y_groups[k])) continue;
      const auto range = [](const NodeRange& of, std::size_t group) {
        const int begin = of.begin + static_cast<int>(group) * kGroup;
        return NodeRange{begin, std::min(of.end, begin + kGroup)};
      };
      for (const ClusterExtent& x : groups(range(rows, i), 1))
        for (const ClusterExtent& y : groups(range(columns, k), 1))
          if (!suffices(x, y)) return false;
    }
  return true;
}

std::vector<int> sampling_order(const SurfacePoints& surface, const NodeRange& nodes,
                                const BoundingBox& seen_from) {
  std::vector<char> seen(surface.points.size(), 0);
  std::vector<int> spread;
  for (int node = nodes.begin; node < nodes.end; ++node)
    for (SurfacePoints::SparseMatrix::InnerIterator it(surface.displacements_at, node); it; ++it) {
      if (seen[it.col()] == 0) spread.push_back(static_cast<int>(it.col()));
      seen[it.col()] = 1;
    }
  std::vector<std::pair<double, int>> closest;
  for (int point : spread) {
    const Vec3& place = surface.points[point].place;
    closest.emplace_back(squared_distance(seen_from, {place, place}), point);
  }
  std::sort(closest.begin(), closest.end());
  // multiples of a number that has no factor in common with their count visit all of it evenly
  const std::size_t count = spread.size();
  constexpr double kGolden = 0.6180339887498949;
  std::size_t stride =
      std::max<std::size_t>(1, static_cast<std::size_t>(kGolden * static_cast<double>(count)));
  while (std::gcd(stride, count) != 1) ++stride;
  std::vector<int> order;
  order.reserve(count);
  const auto take = [&](int point) {
    if (seen[point] == 1) order.push_back(point);
    seen[point] = 2;
  };
  for (std::size_t i = 0, at = 0; i < count; ++i, at = (at + stride) % count) {
    take(closest[i].second);
    take(spread[at]);
  }
  return order;
}

}  // namespace bem
