#pragma once

#include "base/choices.hpp"

namespace bem {

/// How the forces of a contact problem are found (docs/method.md, "Frictional contact: the
/// solver").
enum class FrictionMethod {
  staggered,  ///< projected Gauss-Seidel with staggered projections [Kaufman et al. 2008]
  nsgs,       ///< nonsmooth Gauss-Seidel with exact solves of one contact at a time
  newton,     ///< a few nsgs sweeps, then semismooth Newton, with an interior point fallback
};

template <>
struct Choices<FrictionMethod> {
  static constexpr std::array<Choice<FrictionMethod>, 3> all = {
      {{FrictionMethod::newton, "newton"},
       {FrictionMethod::nsgs, "nsgs"},
       {FrictionMethod::staggered, "staggered"}}};
};

/// The error of forces r is the natural map of the problem, with the scale w_i of every contact's
/// own block (root mean square of its singular values):
///
///     e_i = w_i |r_i - P_K(r_i - (u_i + mu |u_t| n) / w_i)|,   error = |e| / |q|,
///
/// per set of contacts that act on each other, and the largest of these. It does not change with
/// the units of W and q.
struct FrictionOptions {
  FrictionMethod method = FrictionMethod::newton;
  double tolerance = 1e-8;        ///< of the error
  double absolute_tolerance = 0;  ///< of |e| in the unit of q [m]: a set at or below it is solved
  /// |e| [m] and error of a set that are not worth the fallbacks of `newton` once its fast stages
  /// have failed.
  double sufficient = 0, sufficient_error = 0;
  int max_sweeps = 2000;        ///< Gauss-Seidel sweeps (staggered, nsgs)
  int max_newton_steps = 1000;  ///< linear solves (newton)
};

}  // namespace bem
