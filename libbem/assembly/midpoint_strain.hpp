#pragma once

#include "assembly/midpoint_sums.hpp"
#include "assembly/pair_integrals.hpp"

namespace bem {

/// out[3 axes x 6][lane] += J of the tractions of uniform strain, which are linear in the
/// normal, from MidpointSums::uniform.
template <class T>
void add_strain_of_midpoints(const PairIntegrals& pairs, const T* uniform, std::size_t lanes,
                             T* out) {
  const Vector6 pressure = pairs.pressure_of_strain();
  Eigen::Matrix<double, 3, 6> tractions[3];  // of the axes as normals
  for (int k = 0; k < 3; ++k) tractions[k] = pairs.shear_of_strain(Vec3::Unit(k));
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 6; ++c) {
      T* to = out + (6 * i + c) * lanes;
      const auto add = [&](double factor, int entry) {
        if (factor == 0) return;
        const T* from = uniform + entry * lanes;
        for (std::size_t lane = 0; lane < lanes; ++lane)
          to[lane] += static_cast<T>(factor) * from[lane];
      };
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) add(tractions[k](l, c), 9 * i + 3 * l + k);
      add(pressure[c], 27 + i);
    }
}

}  // namespace bem
