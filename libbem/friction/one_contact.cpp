#include "friction/one_contact.hpp"

#include "friction/natural_map.hpp"

#include <array>
#include <cmath>

namespace bem {
namespace {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

constexpr int kSamples = 32;  ///< directions in which a sign change of the polynomial is looked for
constexpr double kSingular =
    1e-10;  ///< determinant over scale^3 of a block that counts as singular

const std::array<Vec2, kSamples>& sample_directions() {
  static const std::array<Vec2, kSamples> directions = [] {
    std::array<Vec2, kSamples> d;
    for (int k = 0; k < kSamples; ++k)
      d[k] = {std::cos(2 * kPi * k / kSamples), std::sin(2 * kPi * k / kSamples)};
    return d;
  }();
  return directions;
}

/// Displacement along and across the direction d of the friction force, times the positive factor
/// g = w_nn + mu w_nt d that makes it a polynomial: g u_t = base + slope d.
struct SlidingPolynomial {
  Vec2 base;
  Mat2 slope;

  double along(const Vec2& d) const { return base.dot(d) + d.dot(slope * d); }
  double across(const Vec2& d) const {
    const Vec2 h = base + slope * d;
    return h[0] * d[1] - h[1] * d[0];
  }
  /// Derivative of across() with respect to the angle.
  double across_slope(const Vec2& d) const {
    const Vec2 turned(-d[1], d[0]), change = slope * turned;
    return along(d) + change[0] * d[1] - change[1] * d[0];
  }
  /// Second derivative.
  double across_curvature(const Vec2& d) const {
    const Vec2 turned(-d[1], d[0]), change = slope * turned, h = base + slope * d,
                                    second = slope * d;
    return h.dot(turned) + 2 * change.dot(d) - (second[0] * d[1] - second[1] * d[0]);
  }
};

Vec2 direction(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

/// Root in [low, high], where `value` changes its sign: Newton with bisection as safeguard.
template <class Value, class Slope>
double bracketed_root(double low, double high, double at_low, const Value& value,
                      const Slope& slope) {
  double x = 0.5 * (low + high);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double f = value(direction(x));
    if (f == 0) return x;
    ((f > 0) == (at_low > 0) ? low : high) = x;
    double next = x - f / slope(direction(x));
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) <= 1e-16) return next;
    x = next;
  }
  return x;
}

}  // namespace

OneContact::OneContact(const Mat3& w, double mu, double scale)
    : w_(w), inverse_(Mat3::Zero()), mu_(mu), scale_(scale) {
  regular_ = std::abs(w.determinant()) > kSingular * scale * scale * scale;
  if (regular_) inverse_ = w.inverse();
}

Vec3 OneContact::solve(const Vec3& b, const Vec3& start) const {
  if (b[0] >= 0) return Vec3::Zero();
  Vec3 r;
  if (solve_states(w_, inverse_, regular_, b, start, r)) return r;
  for (double weight : {1e-8, 1e-4, 1e-2, 1.0}) {
    const double added = weight * scale_;
    const Mat3 w = w_ + added * Mat3::Identity();
    const bool regular =
        std::abs(w.determinant()) > 1e-3 * weight * kSingular * scale_ * scale_ * scale_;
    const Mat3 inverse = regular ? Mat3(w.inverse()) : Mat3::Zero();
    if (solve_states(w, inverse, regular, b - added * start, start, r)) return r;
  }
  return start - natural_map(start, w_ * start + b, mu_, scale_);
}

bool OneContact::solve_states(const Mat3& w, const Mat3& inverse, bool regular, const Vec3& b,
                              const Vec3& start, Vec3& r) const {
  if (b[0] >= 0) {
    r.setZero();
    return true;
  }
  if (regular) {
    r = -inverse * b;
    if (r[0] >= 0 && r.tail<2>().norm() <= mu_ * r[0]) return true;
  }
  return solve_sliding(w, b, start, r);
}

bool OneContact::solve_sliding(const Mat3& w, const Vec3& b, const Vec3& start, Vec3& r) const {
  const Vec2 w_nt = w.block<1, 2>(0, 1).transpose();
  const Vec2 b_t = b.tail<2>();
  if (mu_ == 0) {
    r = {-b[0] / w(0, 0), 0, 0};
    return w(0, 0) > 0;
  }
  SlidingPolynomial p;
  p.base = w(0, 0) * b_t - b[0] * w.block<2, 1>(1, 0);
  p.slope = mu_ * (b_t * w_nt.transpose() - b[0] * w.block<2, 2>(1, 1));
  const auto accept = [&](const Vec2& d) {
    const double g = w(0, 0) + mu_ * w_nt.dot(d);
    if (!(g > 0) || p.along(d) > 0) return false;
    const double n = -b[0] / g;
    r = {n, mu_ * n * d[0], mu_ * n * d[1]};
    return r.allFinite();
  };
  const auto value = [&p](const Vec2& d) { return p.across(d); };
  const auto slope = [&p](const Vec2& d) { return p.across_slope(d); };
  const auto curvature = [&p](const Vec2& d) { return p.across_curvature(d); };

  if (start.tail<2>().squaredNorm() > 0) {
    double angle = std::atan2(start[2], start[1]);
    for (int iteration = 0; iteration < 6; ++iteration) {
      const Vec2 d = direction(angle);
      const double change = p.across(d) / p.across_slope(d);
      if (!(std::abs(change) < 0.3)) break;
      angle -= change;
      if (std::abs(change) < 1e-9 && accept(direction(angle))) return true;
    }
  }
  const auto& samples = sample_directions();
  std::array<double, kSamples> f;
  for (int k = 0; k < kSamples; ++k) f[k] = p.across(samples[k]);
  const double spacing = 2 * kPi / kSamples;
  for (int k = 0; k < kSamples; ++k) {
    const int next = (k + 1) % kSamples;
    const double low = k * spacing, high = low + spacing;
    if ((f[k] > 0) != (f[next] > 0)) {
      if (accept(direction(bracketed_root(low, high, f[k], value, slope)))) return true;
      continue;
    }
    // two roots between the samples show as an extremum on the other side of zero
    const double slope_low = slope(samples[k]), slope_high = slope(samples[next]);
    if ((slope_low > 0) == (slope_high > 0) || (slope_low > 0) == (f[k] > 0)) continue;
    const double turn = bracketed_root(low, high, slope_low, slope, curvature);
    const double extremum = p.across(direction(turn));
    if ((extremum > 0) == (f[k] > 0)) continue;
    if (accept(direction(bracketed_root(low, turn, f[k], value, slope)))) return true;
    if (accept(direction(bracketed_root(turn, high, extremum, value, slope)))) return true;
  }
  return false;
}

}  // namespace bem
