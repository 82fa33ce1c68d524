#include "assembly/midpoint.hpp"

#include <algorithm>

namespace bem {

Midpoint::Midpoint(const Vec3& a, const Vec3& b)
    : place(0.5 * a + 0.5 * b), reach(0.25 * (a - b).norm()) {}

bool leaves_out(const Midpoint& x, const Midpoint& y) {
  const double reach = std::max(x.reach, y.reach);
  return (x.place - y.place).squaredNorm() < reach * reach;
}

}  // namespace bem
