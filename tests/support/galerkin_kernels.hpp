#pragma once

#include "kernels/hypersingular_functions.hpp"

namespace bem {

/// Geometry of a pair of surface points: x, where a function tests, with outward unit normal m, and
/// y, where a function is tried, with outward unit normal n. Rows of all kernels are components at
/// x, columns components at y.
struct SurfacePair {
  double r;  ///< |y - x| > 0 [m]
  Vec3 h;    ///< (y - x)/r
  Vec3 m, n;
};

inline SurfacePair surface_pair(const Vec3& x, const Vec3& m, const Vec3& y, const Vec3& n) {
  const Vec3 d = y - x;
  const double r = d.norm();
  return {r, d / r, m, n};
}

/// Kernel of Z(s) [kg/m^4]: weakly singular, no integration by parts. density: rho [kg/m^3].
template <class Scalar>
Eigen::Matrix<Scalar, 3, 3> inertia_kernel(const SurfacePair& g,
                                           const HypersingularValues<Scalar>& f, double density) {
  const double hm = g.h.dot(g.m), hn = g.h.dot(g.n), mn = g.m.dot(g.n);
  const Mat3 hh = g.h * g.h.transpose();
  const Mat3 first = mn * Mat3::Identity() + g.n * g.m.transpose();
  const Mat3 second = hm * hn * Mat3::Identity() + hm * g.n * g.h.transpose() +
                      hn * g.h * g.m.transpose() + mn * hh;
  const Mat3 fourth = hn * g.m * g.h.transpose() + hm * g.h * g.n.transpose();
  const double scale = density / (4 * kPi * g.r);
  return (scale * f[kAlpha]) * first + (scale * f[kBeta]) * second +
         (scale * f[kGamma]) * (g.m * g.n.transpose()) + (scale * f[kDelta]) * fourth +
         (scale * hm * hn * f[kEpsilon]) * hh;
}

/// Static part of the kernel K' of the traction at x by a unit force at y [1/m^2].
inline Mat3 static_adjoint_kernel(const SurfacePair& g, const StaticTraction& f) {
  const double hm = g.h.dot(g.m);
  return -1 / (4 * kPi * g.r * g.r) *
         (f.p * (hm * Mat3::Identity() + g.h * g.m.transpose()) + f.q * g.m * g.h.transpose() +
          f.s * hm * g.h * g.h.transpose());
}

/// Kernel J(s) of the dynamic part of K', K'(s) = K'(0) + (s/c2)^2 J(s); no dimension, bounded.
template <class Scalar>
Eigen::Matrix<Scalar, 3, 3> dynamic_adjoint_kernel(const SurfacePair& g,
                                                   const HypersingularValues<Scalar>& f) {
  constexpr double kScale = -1 / (4 * kPi);
  const double hm = g.h.dot(g.m);
  const Mat3 first = hm * Mat3::Identity() + g.h * g.m.transpose();
  return (kScale * f[kDynamicP]) * first + (kScale * f[kDynamicQ]) * (g.m * g.h.transpose()) +
         (kScale * hm * f[kDynamicS]) * (g.h * g.h.transpose());
}

/// What J n integrates to over a closed surface, over kappa; no dimension.
template <class Scalar>
Eigen::Matrix<Scalar, 3, 1> pressure_kernel(const SurfacePair& g,
                                            const HypersingularValues<Scalar>& f, double kappa) {
  constexpr double kScale = -1 / (4 * kPi);
  return (kScale * f[kDilation]) *
         ((1 - 2 * kappa) * g.h.dot(g.n) * g.m + 2 * kappa * g.h.dot(g.m) * g.n);
}

/// Static hypersingular form, integrated by parts, of two functions with surface curls a at x and b
/// at y (n x gradient; the sign of both is free) [Pa m^2 / m^4]. Valid for sums over closed
/// surfaces only. mu: shear modulus [Pa].
inline Mat3 static_hypersingular_kernel(double r, const Vec3& h, const Vec3& a, const Vec3& b,
                                        double mu, double kappa) {
  return mu / (4 * kPi * r) *
         (2 * (1 - kappa) * a.dot(b) * (Mat3::Identity() + h * h.transpose()) - a * b.transpose() -
          2 * (1 - 2 * kappa) * b * a.transpose());
}

}  // namespace bem
