#include "mesh/bisection.hpp"

#include "mesh/triangle_mesh.hpp"

#include <algorithm>
#include <numeric>

namespace bem {
namespace {

void bisect(const std::vector<Vec3>& points, int* begin, int count) {
  if (count < 2) return;
  Vec3 low = points[*begin], high = low;
  for (int i = 1; i < count; ++i) {
    low = low.cwiseMin(points[begin[i]]);
    high = high.cwiseMax(points[begin[i]]);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const int half = first_half(count);
  std::nth_element(begin, begin + half, begin + count, [&](int a, int b) {
    return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis] : a < b;
  });
  bisect(points, begin, half);
  bisect(points, begin + half, count - half);
}

}  // namespace

std::vector<int> bisection_order(const std::vector<Vec3>& points) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  bisect(points, order.data(), static_cast<int>(order.size()));
  return order;
}

}  // namespace bem
