#pragma once

#include "base/types.hpp"

#include <array>

namespace bem {

/// c[0] + c[1] t + c[2] t^2 + c[3] t^3
struct Cubic {
  std::array<double, 4> c = {0, 0, 0, 0};

  double operator()(double t) const { return ((c[3] * t + c[2]) * t + c[1]) * t + c[0]; }
};

/// A vector that changes linearly over a step: start + t (end - start), t in [0, 1].
struct LinearVector {
  Vec3 start, change;
};

/// w . (u x v) as a polynomial of t.
Cubic triple_product(const LinearVector& w, const LinearVector& u, const LinearVector& v);

/// A time in [0, 1] at which a cubic changes its sign.
struct Crossing {
  double time = 0;
  bool falling = false;  ///< from positive to negative, else the other way
};

struct Crossings {
  int count = 0;
  std::array<Crossing, 3> at;  ///< in the order of time
};

/// Sign changes in [0, 1], to the last bits of t: between the extrema a sign change is bracketed
/// and found by Newton's method with bisection. Zero counts as negative.
Crossings sign_changes(const Cubic& f);

}  // namespace bem
