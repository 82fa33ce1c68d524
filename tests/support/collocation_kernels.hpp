#pragma once

#include "base/symmetric_matrix.hpp"
#include "kernels/radial_functions.hpp"

namespace bem {

/// Geometry of a pair: field point x, integration point y with outward unit normal n.
/// Everywhere row i = direction of the unit force at x, column j = component of the response at y.
struct PairGeometry {
  double r;  ///< |y - x| > 0 [m]
  Vec3 h;    ///< (y - x)/r
  Vec3 n;    ///< outward unit normal at y
};

inline PairGeometry pair_geometry(const Vec3& x, const Vec3& y, const Vec3& n) {
  const Vec3 d = y - x;
  const double r = d.norm();
  return {r, d / r, n};
}

/// Displacement kernel u* [m/N] times the Laplace factor (M3). mu: shear modulus [Pa].
template <class Scalar>
Eigen::Matrix<Scalar, 3, 3> displacement_kernel(const PairGeometry& g,
                                                const RadialValues<Scalar>& f, double mu) {
  const Mat3 hh = g.h * g.h.transpose();
  const double scale = 1 / (4 * kPi * mu * g.r);
  return (scale * f[kRadialA]) * Mat3::Identity() - (scale * f[kRadialB]) * hh;
}

/// Traction kernel p* [1/m^2] (M4).
template <class Scalar>
Eigen::Matrix<Scalar, 3, 3> traction_kernel(const PairGeometry& g, const RadialValues<Scalar>& f) {
  const double hn = g.h.dot(g.n);
  const Mat3 p = hn * Mat3::Identity() + g.n * g.h.transpose();
  const double scale = 1 / (4 * kPi * g.r * g.r);
  return (scale * f[kRadialP]) * p + (scale * f[kRadialQ]) * (g.h * g.n.transpose()) +
         (scale * hn * f[kRadialS]) * (g.h * g.h.transpose());
}

/// Kernel d* of a uniform acceleration of the frame [s^2/m^2] (M5). c2: shear wave speed [m/s].
template <class Scalar>
Eigen::Matrix<Scalar, 3, 3> translation_kernel(const PairGeometry& g, const RadialValues<Scalar>& f,
                                               double c2) {
  const double scale = 1 / (4 * kPi * c2 * c2);
  return (scale * f[kRadialF]) * (g.h * g.n.transpose()) -
         (scale * g.h.dot(g.n) * f[kRadialM1]) * Mat3::Identity();
}

/// Kernel l* of the Euler force [s^2/m] (M6); the full kernel is q* = l* + d* [x - xbar]^T.
template <class Scalar>
Eigen::Matrix<Scalar, 3, 3> rotation_kernel(const PairGeometry& g, const RadialValues<Scalar>& f,
                                            double c2) {
  const double scale = g.r / (4 * kPi * c2 * c2);
  return (scale * f[kRadialF]) * (g.h * g.h.cross(g.n).transpose()) +
         (scale * f[kRadialM0]) * cross_matrix(g.n);
}

/// Kernel m* of the body force rho B y, B symmetric [s^2/m] (M7); the full kernel is
/// m*(B) - d* B (x - xbar). Column e: B = symmetric_matrix(unit vector e).
template <class Scalar>
Eigen::Matrix<Scalar, 3, 6> strain_kernel(const PairGeometry& g, const RadialValues<Scalar>& f,
                                          double c2) {
  const double scale = g.r / (4 * kPi * c2 * c2);
  const Scalar dilation = f[kRadialC0] - f[kRadialM0] + f[kRadialF];  // kappa W(z1) - W(z2)
  const Vector6 trace = symmetric_entries(Mat3::Identity());
  return (scale * f[kRadialM0]) * symmetric_products(g.n) -
         (scale * f[kRadialF]) * (g.h * (g.n.transpose() * symmetric_products(g.h))) -
         (scale * dilation) * (g.n * trace.transpose());
}

}  // namespace bem
