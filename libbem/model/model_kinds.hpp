#pragma once

#include "base/choices.hpp"

namespace bem {

/// How a body moves and deforms.
enum class ModelKind {
  dynamic,      ///< elastodynamic matrices
  quasistatic,  ///< elastostatic matrices: the deformation has no inertia and no history
  rigid         ///< geometry and mass alone
};

template <>
struct Choices<ModelKind> {
  static constexpr std::array<Choice<ModelKind>, 3> all = {{{ModelKind::dynamic, "dynamic"},
                                                            {ModelKind::quasistatic, "static"},
                                                            {ModelKind::rigid, "rigid"}}};
};

/// Which nodes of a body contacts, joints and fixed vertices may act on. Prescribed tractions need
/// none of them.
enum class Loads { all, some, none };

template <>
struct Choices<Loads> {
  static constexpr std::array<Choice<Loads>, 3> all = {
      {{Loads::all, "all"}, {Loads::some, "some"}, {Loads::none, "none"}}};
};

/// How a step solves with the matrices of lag 0.
enum class InverseKind {
  dense,     ///< with the stored inverse, from a dense factorisation
  iterative  ///< with H_0 itself
};

template <>
struct Choices<InverseKind> {
  static constexpr std::array<Choice<InverseKind>, 2> all = {
      {{InverseKind::dense, "dense"}, {InverseKind::iterative, "iterative"}}};
};

}  // namespace bem
