#include "dynamics/deformation_watch.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

/// A triangle in its own axes: the first along its first edge, the last along its normal.
struct TriangleAxes {
  Mat3 axes;
  double length, along, height;  ///< corners (0, 0), (length, 0), (along, height) [m]

  TriangleAxes(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 edge = b - a, side = c - a;
    length = edge.norm();
    axes.col(0) = edge / length;
    axes.col(2) = edge.cross(side).normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    along = side.dot(axes.col(0));
    height = side.dot(axes.col(1));
  }
  double area() const { return 0.5 * length * height; }
};

/// Trace of the rotation of the polar decomposition. In the triangles' axes the gradient is upper
/// triangular, [[a, b], [0, d]], and its rotation is by atan2(-b, a + d) about the normal.
double trace_of_rotation(const TriangleAxes& rest, const TriangleAxes& now) {
  const double a = now.length / rest.length, d = now.height / rest.height;
  const double b = (now.along - a * rest.along) / rest.height;
  const double norm = std::hypot(b, a + d), cosine = (a + d) / norm, sine = -b / norm;
  const Vec3 first = cosine * now.axes.col(0) + sine * now.axes.col(1);
  const Vec3 second = cosine * now.axes.col(1) - sine * now.axes.col(0);
  return first.dot(rest.axes.col(0)) + second.dot(rest.axes.col(1)) +
         now.axes.col(2).dot(rest.axes.col(2));
}

double angle_of(double trace) {
  return std::acos(std::clamp(0.5 * (trace - 1), -1.0, 1.0));
}

void take_least(Extreme& extreme, double value, double time, int triangle) {
  if (value < extreme.value) extreme = {value, time, triangle};
}

void take_most(Extreme& extreme, double value, double time, int triangle) {
  if (value > extreme.value) extreme = {value, time, triangle};
}

/// Six times the volume of the tetrahedron of a triangle and a point.
double six_volumes(const std::vector<Vec3>& x, const Triangle& t, const Vec3& origin) {
  return (x[t[0]] - origin).dot((x[t[1]] - origin).cross(x[t[2]] - origin));
}

}  // namespace

void DeformationWatch::record(const TriangleMesh& rest, const std::vector<Vec3>& vertices,
                              double time) {
  const auto count = static_cast<Eigen::Index>(rest.triangles.size());
  const bool first = normals_.cols() != count;
  if (first) {
    normals_.resize(3, count);
    inverted_.assign(rest.triangles.size(), 0);
  }
  const double most_trace = 1 + 2 * std::cos(kMostRotation);
  const Vec3 rest_origin = rest.vertices.front(), origin = vertices.front();
  double area = 0, rest_volume = 0, volume = 0, least_trace = 3;
  int most_turned = -1;
  double turned = 0, stretched = 0, inverted = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const int triangle = static_cast<int>(i);
    const Triangle& t = rest.triangles[triangle];
    const TriangleAxes before(rest.vertices[t[0]], rest.vertices[t[1]], rest.vertices[t[2]]);
    const TriangleAxes now(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
    if (first) normals_.col(i) = before.axes.col(2);
    const double whole = before.area(), ratio = now.area() > 0 ? now.area() / whole : 0;
    area += whole;
    rest_volume += six_volumes(rest.vertices, t, rest_origin);
    volume += six_volumes(vertices, t, origin);
    take_least(least_area_, ratio, time, triangle);
    take_most(most_area_, ratio, time, triangle);
    if (ratio < kLeastArea || ratio > kMostArea) stretched += whole;
    if (ratio > 0) {
      if (now.axes.col(2).dot(normals_.col(i)) < 0) inverted_[triangle] = !inverted_[triangle];
      normals_.col(i) = now.axes.col(2);
      const double trace = trace_of_rotation(before, now);
      if (trace < most_trace) turned += whole;
      if (trace < least_trace) {
        least_trace = trace;
        most_turned = triangle;
      }
    }
    if (inverted_[triangle]) inverted += whole;
  }
  take_least(least_volume_, volume / rest_volume, time, -1);
  take_most(most_volume_, volume / rest_volume, time, -1);
  take_most(rotation_, angle_of(least_trace), time, most_turned);
  take_most(turned_, turned / area, time, most_turned);
  take_most(stretched_, stretched / area, time, -1);
  take_most(inverted_share_, inverted / area, time, -1);
  inside_out_ = !(volume / rest_volume > 0) || inverted / area > kMostInverted;
  was_inside_out_ = was_inside_out_ || inside_out_;
  const bool beyond = least_volume_.value < kLeastVolume || most_volume_.value > kMostVolume ||
                      turned_.value > kLargestShare || stretched_.value > kLargestShare;
  if (beyond) beyond_since_ = std::min(beyond_since_, time);
}

}  // namespace bem
