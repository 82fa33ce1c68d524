#include "mesh/closest_points.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace bem {

// Voronoi regions of corners, edges and face in turn (Ericson, Real-Time Collision Detection, 5.1).
NearestPoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  using Feature = NearestPoint::Feature;
  const Vec3 ab = b - a, ac = c - a;
  const double d1 = ab.dot(p - a), d2 = ac.dot(p - a);
  if (d1 <= 0 && d2 <= 0) return {Feature::corner, 0, {1, 0, 0}, a};
  const double d3 = ab.dot(p - b), d4 = ac.dot(p - b);
  if (d3 >= 0 && d4 <= d3) return {Feature::corner, 1, {0, 1, 0}, b};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double w = d1 / (d1 - d3);
    return {Feature::edge, 0, {1 - w, w, 0}, a + w * ab};
  }
  const double d5 = ab.dot(p - c), d6 = ac.dot(p - c);
  if (d6 >= 0 && d5 <= d6) return {Feature::corner, 2, {0, 0, 1}, c};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double w = d2 / (d2 - d6);
    return {Feature::edge, 2, {1 - w, 0, w}, a + w * ac};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {Feature::edge, 1, {0, 1 - w, w}, b + w * (c - b)};
  }
  const double sum = va + vb + vc;
  const double v = vb / sum, w = vc / sum;
  return {Feature::face, -1, {1 - v - w, v, w}, a + v * ab + w * ac};
}

LinePair closest_on_lines(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& t) {
  const Vec3 d = q - p, e = t - r, normal = d.cross(e);
  const double lengths = d.norm() * e.norm(), area2 = normal.squaredNorm();
  LinePair pair;
  if (!(area2 > 0)) return pair;
  pair.sine = std::sqrt(area2) / lengths;
  const Vec3 between = r - p;
  pair.s = between.cross(e).dot(normal) / area2;
  pair.u = between.cross(d).dot(normal) / area2;
  return pair;
}

double point_segment_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 e = b - a;
  const double t = std::clamp((p - a).dot(e) / e.squaredNorm(), 0.0, 1.0);
  return (p - a - t * e).norm();
}

double point_triangle_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  const bool inside = (b - a).cross(p - a).dot(n) >= 0 && (c - b).cross(p - b).dot(n) >= 0 &&
                      (a - c).cross(p - c).dot(n) >= 0;
  if (inside) return std::abs((p - a).dot(n)) / n.norm();
  return std::min({point_segment_distance(p, a, b), point_segment_distance(p, b, c),
                   point_segment_distance(p, c, a)});
}

double segment_distance(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& t) {
  constexpr double kParallel = 1e-12;  // square of the sine below which any s is as good
  const Vec3 d = q - p, e = t - r, w = p - r;
  const double dd = d.squaredNorm(), de = d.dot(e), ee = e.squaredNorm(), dw = d.dot(w),
               ew = e.dot(w);
  const double det = dd * ee - de * de;
  double s = det > kParallel * dd * ee ? std::clamp((de * ew - ee * dw) / det, 0.0, 1.0) : 0.0;
  const double u = std::clamp((de * s + ew) / ee, 0.0, 1.0);
  s = std::clamp((de * u - dw) / dd, 0.0, 1.0);
  return (w + s * d - u * e).norm();
}

double triangle_distance(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
  double distance = (a[0] - b[0]).norm();
  for (int i = 0; i < 3; ++i) {
    distance = std::min({distance, point_triangle_distance(a[i], b[0], b[1], b[2]),
                         point_triangle_distance(b[i], a[0], a[1], a[2])});
    for (int j = 0; j < 3; ++j)
      distance = std::min(distance, segment_distance(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
  }
  return distance;
}

}  // namespace bem
