#pragma once

#include "base/types.hpp"

namespace bem {

/// The contact law of one point with a linear response u = w r + b, solved exactly by enumerating
/// its states: open, sticking, and sliding. A sliding force r_n (1, mu cos a, mu sin a) with u_n =
/// 0 opposes u_t where a trigonometric polynomial of degree two in a vanishes, which has at most
/// four roots [Bonnefon and Daviet 2011].
class OneContact {
 public:
  /// `scale`: magnitude of the block, for the regularisation where `w` is singular.
  OneContact(const Mat3& w, double mu, double scale);

  /// The force; `start` is a guess of it. Where no state fits (`w` singular or far from positive
  /// definite), the step from `start` with the least regularisation that has a solution.
  Vec3 solve(const Vec3& b, const Vec3& start) const;

 private:
  bool solve_states(const Mat3& w, const Mat3& inverse, bool regular, const Vec3& b,
                    const Vec3& start, Vec3& r) const;
  bool solve_sliding(const Mat3& w, const Vec3& b, const Vec3& start, Vec3& r) const;

  Mat3 w_, inverse_;
  double mu_, scale_;
  bool regular_;
};

}  // namespace bem
