#pragma once

#include "base/types.hpp"

#include <vector>

namespace bem {

/// Geometry of a flat triangle seen from its vertex x: e1, e2 are the edges from x to the other two
/// vertices in counter-clockwise order (M30).
class VertexTriangle {
 public:
  VertexTriangle(const Vec3& x, const Vec3& b, const Vec3& c);

  /// int p*_static phi_a for the shape functions of b (a = 1) and c (a = 2): the antisymmetric part
  /// of Kelvin's traction kernel, analytic (M33).
  Mat3 static_traction(int a, double kappa) const;

  /// Share of this triangle in the Cauchy principal value of int p*_static phi_x; the logarithms
  /// cancel over a closed fan and are left out (M35).
  Mat3 static_traction_own(double kappa) const;

  const Vec3& normal() const { return normal_; }
  double area() const { return area_; }
  /// Angle at x [rad].
  double angle() const;

  /// One point of the polar rule about x: weight includes the Jacobian, so that a kernel up to 1/r
  /// is integrated without singularity (M31).
  struct Point {
    Vec3 y;
    double shape[3];  ///< linear shape functions of x, b, c
    double weight;    ///< [m^2]
  };
  /// angular x radial Gauss points.
  void polar_points(int angular, int radial, std::vector<Point>& points) const;

 private:
  Vec3 x_, e1_, e2_, t_, foot_, normal_;
  double length_, s1_, s2_, d_, area_;
};

/// Numbers of Gauss points of the polar rule for a relative tolerance: angular points grow with the
/// angle at x, radial points with Z = |s|_max * longest edge / c2.
struct PolarOrder {
  int angular, radial;
};
PolarOrder polar_order(double tolerance, double angle, double oscillation);

}  // namespace bem
