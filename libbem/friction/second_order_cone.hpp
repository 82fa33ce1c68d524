#pragma once

#include "base/types.hpp"

namespace bem::cone {

/// The Lorentz cone {x_0 >= |(x_1, x_2)|} and its Jordan algebra.

/// x_0^2 - x_1^2 - x_2^2.
double determinant(const Vec3& x);

/// (x . y, x_0 y_t + y_0 x_t).
Vec3 product(const Vec3& x, const Vec3& y);

/// The y with product(x, y) = b, x inside the cone.
Vec3 quotient(const Vec3& b, const Vec3& x);

/// The largest step t for which x + t d stays in the cone that x is inside of; 1e10 if none.
double step_to_boundary(const Vec3& x, const Vec3& d);

/// The scaling of Nesterov and Todd: the symmetric S that maps the cone to itself with
/// S z = S^{-1} y, for y and z inside the cone.
struct Scaling {
  Mat3 matrix, inverse;
  Vec3 point;  ///< S z
};
Scaling nesterov_todd(const Vec3& y, const Vec3& z);

}  // namespace bem::cone
