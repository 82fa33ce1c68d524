#include "mesh/ordering.hpp"

#include "mesh/triangle_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace bem {
namespace {

constexpr int kBits = 21;  // three coordinates fill 63 bits of the key

/// Position along the Hilbert curve of a cell of the 2^kBits grid (J. Skilling, Programming the
/// Hilbert curve, AIP Conf. Proc. 707, 2004: axes to transpose).
std::uint64_t hilbert_key(std::array<std::uint32_t, 3> x) {
  for (std::uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1) {
    const std::uint32_t below = q - 1;
    for (std::uint32_t& axis : x) {
      if (axis & q) {
        x[0] ^= below;
      } else {
        const std::uint32_t swap = (x[0] ^ axis) & below;
        x[0] ^= swap;
        axis ^= swap;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t flip = 0;
  for (std::uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1)
    if (x[2] & q) flip ^= q - 1;
  for (std::uint32_t& axis : x) axis ^= flip;

  std::uint64_t key = 0;
  for (int bit = kBits - 1; bit >= 0; --bit)
    for (std::uint32_t axis : x) key = (key << 1) | ((axis >> bit) & 1u);
  return key;
}

}  // namespace

std::vector<int> hilbert_order(const std::vector<Vec3>& points) {
  const BoundingBox box = bounding_box(points);
  const double side = (box.max - box.min).maxCoeff();
  const double cells = std::ldexp(1.0, kBits);
  std::vector<std::uint64_t> keys(points.size(), 0);
  for (std::size_t i = 0; i < points.size() && side > 0; ++i) {
    std::array<std::uint32_t, 3> cell{};
    for (int k = 0; k < 3; ++k) {
      const double position = (points[i][k] - box.min[k]) / side * cells;
      cell[k] = static_cast<std::uint32_t>(std::clamp(position, 0.0, cells - 1.0));
    }
    keys[i] = hilbert_key(cell);
  }
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return keys[a] < keys[b]; });
  return order;
}

}  // namespace bem
