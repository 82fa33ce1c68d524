#include "collision/coplanarity.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace bem {
namespace {

/// The root in [low, high] of a cubic that is monotone there and has opposite signs at the ends.
double bracketed_root(const Cubic& f, double low, double high) {
  const bool rising = f(high) > 0;
  double t = 0.5 * (low + high);
  for (int i = 0; i < 80; ++i) {
    const double value = f(t);
    if (value == 0) return t;
    ((value > 0) == rising ? high : low) = t;
    const double slope = (3 * f.c[3] * t + 2 * f.c[2]) * t + f.c[1];
    double next = t - value / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == t || next == low || next == high || std::abs(next - t) < 1e-16) return next;
    t = next;
  }
  return t;
}

/// Extrema of f in (0, 1), ascending; returns how many.
int extrema(const Cubic& f, std::array<double, 2>& at) {
  const double a = 3 * f.c[3], b = f.c[2], c = f.c[1];  // a t^2 + 2 b t + c
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return 0;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  int count = 0;
  for (const double t : {q / a, c / q})
    if (t > 0 && t < 1) at[count++] = t;
  if (count == 2 && at[0] > at[1]) std::swap(at[0], at[1]);
  return count;
}

}  // namespace

Cubic triple_product(const LinearVector& w, const LinearVector& u, const LinearVector& v) {
  const Vec3 n0 = u.start.cross(v.start);
  const Vec3 n1 = u.change.cross(v.start) + u.start.cross(v.change);
  const Vec3 n2 = u.change.cross(v.change);
  return {{w.start.dot(n0), w.change.dot(n0) + w.start.dot(n1), w.change.dot(n1) + w.start.dot(n2),
           w.change.dot(n2)}};
}

Crossings sign_changes(const Cubic& f) {
  std::array<double, 4> knots = {0, 1, 1, 1};
  std::array<double, 2> inner = {0, 0};
  const int inner_count = extrema(f, inner);
  for (int i = 0; i < inner_count; ++i) knots[i + 1] = inner[i];
  knots[inner_count + 1] = 1;
  Crossings found;
  for (int i = 0; i <= inner_count; ++i) {
    const bool before = f(knots[i]) > 0, after = f(knots[i + 1]) > 0;
    if (before != after)
      found.at[found.count++] = {bracketed_root(f, knots[i], knots[i + 1]), before};
  }
  return found;
}

}  // namespace bem
