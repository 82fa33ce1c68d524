#pragma once

#include "base/types.hpp"

#include <vector>

namespace bem {

/// x -> centre + rotation * (X - rest_centre).
struct RigidFit {
  Vec3 rest_centre = Vec3::Zero(), centre = Vec3::Zero();  ///< of the points [m]
  Mat3 rotation = Mat3::Identity();
};

/// The rigid motion that brings points nearest to where they have gone: it minimises
/// sum_i w_i |x_i - centre - R (X_i - rest_centre)|^2 (Horn 1987: the rotation is the eigenvector
/// of a symmetric 4 x 4 matrix). `weights`: > 0, sum 1. O(points).
RigidFit fit_rigid_motion(const std::vector<Vec3>& rest, const std::vector<Vec3>& positions,
                          const std::vector<double>& weights);

}  // namespace bem
