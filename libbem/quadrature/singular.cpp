#include "quadrature/singular.hpp"

#include "quadrature/gauss.hpp"

#include <algorithm>
#include <cmath>

namespace bem {

VertexTriangle::VertexTriangle(const Vec3& x, const Vec3& b, const Vec3& c)
    : x_(x), e1_(b - x), e2_(c - x) {
  length_ = (c - b).norm();
  t_ = (c - b) / length_;
  s1_ = e1_.dot(t_);
  s2_ = e2_.dot(t_);
  foot_ = e1_ - s1_ * t_;
  d_ = foot_.norm();
  const Vec3 doubled = e1_.cross(e2_);
  area_ = 0.5 * doubled.norm();
  normal_ = doubled / (2 * area_);
}

double VertexTriangle::angle() const {
  return std::atan2(e1_.cross(e2_).norm(), e1_.dot(e2_));
}

Mat3 VertexTriangle::static_traction(int a, double kappa) const {
  const double r1 = e1_.norm(), r2 = e2_.norm();
  const double tau = std::log((r1 + r2 + length_) / (r1 + r2 - length_));
  // in-plane gradients: perpendicular to the opposite edge, |g_1| = R2/(2A), |g_2| = R1/(2A)
  const Vec3 gradient =
      a == 1 ? Vec3(e2_.cross(normal_) / (2 * area_)) : Vec3(normal_.cross(e1_) / (2 * area_));
  const Vec3 ed = foot_ / d_;
  const double gc = gradient.dot(ed), gs = gradient.dot(t_);
  const double dsp = s2_ / r2 - s1_ / r1, dcp = d_ / r2 - d_ / r1;
  const double ic = gc * dsp - gs * dcp;
  const double is = -gc * dcp + gs * (tau - dsp);
  const Vec3 h = d_ * (ic * ed + is * t_);
  return kappa / (4 * kPi) * cross_matrix(normal_.cross(h));
}

Mat3 VertexTriangle::static_traction_own(double kappa) const {
  const double r1 = e1_.norm(), r2 = e2_.norm();
  const double tau = std::log((r1 + r2 + length_) / (r1 + r2 - length_));
  return -kappa / (4 * kPi) * tau * cross_matrix(t_);
}

void VertexTriangle::polar_points(int angular, int radial, std::vector<Point>& points) const {
  const GaussRule angle_rule = gauss_rule(angular), radius_rule = gauss_rule(radial);
  const double v1 = std::asinh(s1_ / d_), v2 = std::asinh(s2_ / d_);
  points.clear();
  for (int i = 0; i < angular; ++i) {
    const double v = v1 + (v2 - v1) * angle_rule.nodes[i];
    const double s = d_ * std::sinh(v);
    const Vec3 ray = foot_ + s * t_;
    const double m = (s - s1_) / length_;
    const double angular_weight =
        (v2 - v1) * angle_rule.weights[i] * ray.squaredNorm() / std::cosh(v);
    for (int j = 0; j < radial; ++j) {
      const double g = radius_rule.nodes[j];
      Point p;
      p.y = x_ + g * ray;
      p.shape[0] = 1 - g;
      p.shape[1] = g * (1 - m);
      p.shape[2] = g * m;
      p.weight = angular_weight * radius_rule.weights[j] * g;
      points.push_back(p);
    }
  }
}

namespace {

constexpr int kTolerances = 4;
constexpr double kLogTolerance[kTolerances] = {-4, -6, -8, -12};

// Measured numbers of points for the tolerances above  [docs/method.md, "Singular triangles"].
constexpr double kAngles[4] = {60, 90, 120, 165};
constexpr double kAngular[4][kTolerances] = {
    {4, 5, 7, 9}, {5, 7, 9, 12}, {6, 9, 11, 16}, {11, 15, 20, 28}};
constexpr double kOscillations[3] = {0.5, 4.2, 8};
constexpr double kRadial[3][kTolerances] = {{4, 4, 5, 5}, {5, 6, 7, 10}, {6, 7, 8, 10}};

/// Bilinear interpolation in (x, log tolerance); goes on linearly beyond the last x.
template <std::size_t n>
int interpolate_order(const double (&grid)[n], const double (&rows)[n][kTolerances], double x,
                      double log_tolerance) {
  int column = 0;
  while (column < kTolerances - 2 && log_tolerance < kLogTolerance[column + 1]) ++column;
  const double f =
      (kLogTolerance[column] - log_tolerance) / (kLogTolerance[column] - kLogTolerance[column + 1]);
  std::size_t i = 0;
  for (std::size_t next = 1; next + 1 < n; ++next)
    if (x > grid[next]) i = next;
  const double g = std::max(0.0, (x - grid[i]) / (grid[i + 1] - grid[i]));
  const auto at = [&](const double* row) {
    return row[column] + f * (row[column + 1] - row[column]);
  };
  const double order = at(rows[i]) + g * (at(rows[i + 1]) - at(rows[i]));
  constexpr int kMostPoints = 60;
  return std::min(kMostPoints, static_cast<int>(std::ceil(order)));
}

}  // namespace

PolarOrder polar_order(double tolerance, double angle, double oscillation) {
  const double log_tolerance =
      std::clamp(std::log10(tolerance), kLogTolerance[kTolerances - 1], kLogTolerance[0]);
  return {interpolate_order(kAngles, kAngular, angle * 180 / kPi, log_tolerance),
          interpolate_order(kOscillations, kRadial, oscillation, log_tolerance)};
}

}  // namespace bem
