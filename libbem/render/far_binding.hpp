#pragma once

#include "mesh/triangle_mesh.hpp"

#include <array>
#include <vector>

namespace bem {

/// Points that are far from a surface and go with all of it, not with the one place that happens to
/// be closest: parts inside of a body.
///
/// The surface is divided into patches k with mean positions X_k, X_k' and mean gradients F_k
/// (render/surface_gradients.hpp). A point x goes where the affine motion z -> x' + B (z - x) takes
/// it that fits them best,
///
///   sum_k w_k ( |x' + B (X_k - x) - X_k'|^2 + m h^2 |B - F_k|^2 )  minimal,
///
/// with weights w_k = area / distance^4, m = 1e-6 and h the spread of the patches. Rigid motions
/// are exact up to rounding, linear deformations up to m, and gradients say what patches in one
/// plane leave open.
class FarBinding {
 public:
  static constexpr std::size_t kPatches = 32;

  /// Mean positions and gradients of the patches.
  struct Pose {
    std::vector<Vec3> positions;
    std::vector<Mat3> gradients;
  };

  /// How a point depends on the patches.
  struct Point {
    std::array<double, kPatches> weights;  ///< their sum is 1
    std::array<double, kPatches> slopes;   ///< of positions relative to their mean
    Vec3 lever;                            ///< that the mean gradient acts on [m]
  };

  /// O(patches x vertices).
  explicit FarBinding(const TriangleMesh& rest);

  Point bind(const Vec3& x) const;
  /// O(vertices).
  Pose pose(const std::vector<Vec3>& positions, const std::vector<Mat3>& gradients) const;
  static Vec3 position(const Pose& pose, const Point& point);

 private:
  void choose_patches(const TriangleMesh& rest);

  std::vector<int> patch_of_;   ///< by vertex
  std::vector<double> shares_;  ///< of each vertex in its patch
  std::vector<double> areas_;   ///< of the patches [m^2]
  std::vector<Vec3> means_;     ///< at rest
  double least2_ = 0;           ///< added to squares of distances [m^2]
};

}  // namespace bem
