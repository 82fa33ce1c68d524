#pragma once

#include "base/choices.hpp"

namespace bem {

/// Discretisation in space.
enum class SpatialMethod {
  collocation,  ///< linear displacements, at the vertices: the paper's
  galerkin      ///< hypersingular equation, displacements with reconstructed edges
};

template <>
struct Choices<SpatialMethod> {
  static constexpr std::array<Choice<SpatialMethod>, 2> all = {
      {{SpatialMethod::galerkin, "galerkin"}, {SpatialMethod::collocation, "collocation"}}};
};

}  // namespace bem
