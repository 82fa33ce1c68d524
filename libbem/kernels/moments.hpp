#pragma once

#include "base/types.hpp"

namespace bem {

/// Moments M_n(z) = int_0^1 t^n exp(-z t) dt of the exponential, and e = exp(-z)  (M2).
struct Moments {
  Complex e, m0, m1, m2, m3;
  Complex zz_m1, zz_m3;  ///< z^2 M_1 and z^2 M_3, bounded for all z and without loss of digits
};

/// Evaluates the moments to about 1e-15 for Re z >= 0, however small |z| is: a Kummer series with
/// downward recurrence for |z| < 2, upward recurrence beyond  (M8).
Moments exponential_moments(Complex z);

}  // namespace bem
