#pragma once

#include "compress/family_builder.hpp"
#include "model/initial_inverse.hpp"
#include "model/slab_assembly.hpp"

#include <optional>
#include <vector>

namespace bem {

/// Calls f(i, part, parts) for every initial component i, whose parts of lag 0 begin with `part`.
template <class F>
void for_each_initial(const Scheme& scheme, const F& f) {
  int part = 0;
  for (std::size_t i = 0; i < scheme.initial_components().size(); ++i) {
    const int parts = scheme.initial_components()[i].paired ? 2 : 1;
    f(i, part, parts);
    part += parts;
  }
}

/// What the slabs of the matrices become; what is not wanted is empty.
template <class T>
struct AssemblyTargets {
  std::unique_ptr<FamilyBuilder<T>> h, g;                               ///< lags, if any
  std::unique_ptr<FamilyBuilder<T>> stiffness;                          ///< of the inertial form
  std::vector<std::unique_ptr<FamilyBuilder<T>>> initial_h, initial_g;  ///< by initial component
  std::vector<InitialMatrix> dense_h, dense_g;  ///< the same, to be inverted
  bool without_stiffness = false;               ///< D(0) is left out of dense_h
  double g_part = 1;                   ///< norm of G over that which its errors are measured by
  std::optional<MatrixSlab<T>> known;  ///< a slab that is assembled already
};

/// Matrices of lag 0 to be inverted, one for each initial component; `form`: of them.
inline std::vector<InitialMatrix> dense_matrices(const BodyModel& model, MatrixForm form) {
  std::vector<InitialMatrix> out;
  for (const InitialComponent& c : model.discretisation.scheme.initial_components())
    out.emplace_back(static_cast<Eigen::Index>(3 * model.nodes()), c.paired, form);
  return out;
}

}  // namespace bem
