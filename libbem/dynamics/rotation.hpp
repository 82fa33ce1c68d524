#pragma once

#include "base/types.hpp"

namespace bem {

/// exp([v]_x): rotation by |v| [rad] about v (Rodrigues' formula, accurate for small angles).
Mat3 rotation_exp(const Vec3& v);

/// Rotation vector of R, |v| <= pi.
Vec3 rotation_log(const Mat3& rotation);

/// Rate of the rotation vector theta of R = exp([theta]_x) R_0 when R turns with the angular
/// velocity omega (same axes as theta): inverse of the left-trivialised differential of exp.
Vec3 rotation_vector_rate(const Vec3& theta, const Vec3& omega);

/// The rotation R that makes trace(R^T m) largest: with m = sum w_i y_i x_i^T the one that brings
/// the x_i nearest to the y_i, in the mean of the squares with weights w_i.
Mat3 best_rotation(const Mat3& m);

/// The nearest rotation, against the drift of many products.
Mat3 orthonormalised(const Mat3& rotation);

}  // namespace bem
