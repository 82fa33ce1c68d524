#pragma once

#include "render/far_binding.hpp"
#include "render/point_normal.hpp"
#include "render/surface_gradients.hpp"

#include <array>
#include <vector>

namespace bem {

/// Where a surface has gone: positions of its vertices and gradients there.
struct SurfacePose {
  std::vector<Vec3> positions;
  std::vector<Mat3> gradients;
  std::vector<Mat3> cofactors;  ///< of the gradients: they turn normals
  FarBinding::Pose patches;
};

/// Points that go with a triangle surface, on it or not. A point x is bound to the point p of the
/// surface that is closest to it, with barycentric coordinates b_i, and goes to
///
///   x' = sum_i b_i (x_i' + F_i (x - p)),
///
/// where the x_i' are the three vertices around p and F_i the gradients there
/// (render/surface_gradients.hpp). Rigid motions are exact up to rounding; motions that are linear
/// in space are exact for points on the surface.
///
/// Points that have a normal keep away from parts of the surface that face the other way, the other
/// side of a thin wall: a part that does not is taken instead if it is at most four times as far
/// away. Whether a part of the points' own mesh is inside out is found by what most of it says.
/// Points at the same place are bound in the same way.
///
/// Points farther away than 5 % of the diagonal of the surface's box go more and more, from 15 % on
/// alone, with all of the surface (render/far_binding.hpp).
class SurfaceBinding {
 public:
  /// `surface`: at rest, closed or open, at least one triangle. `bound`: the points, in the same
  /// coordinates, and triangles that give them normals. O(n log n).
  SurfaceBinding(const TriangleMesh& surface, const TriangleMesh& bound);

  std::size_t size() const { return points_.size(); }
  double farthest() const { return farthest_; }  ///< distance of a point from the surface [m]

  SurfacePose pose(std::vector<Vec3> positions) const;
  /// Where the points have gone. O(points).
  std::vector<Vec3> points(const SurfacePose& pose) const;
  /// Unit normals at some of the points, turned as the surface turns and deforms; those of length
  /// zero stay zero, those of no point as they are. O(normals).
  std::vector<Vec3> normals(const SurfacePose& pose, const std::vector<PointNormal>& normals) const;
  /// Values at the vertices of the surface, a column each, interpolated linearly at the points.
  Eigen::MatrixXd interpolate(const Eigen::MatrixXd& values) const;

 private:
  struct Point {
    Triangle vertices;
    std::array<double, 3> weights;
    Vec3 offset;  ///< x - p [m]
  };
  /// A point that is far away, and how much it goes with all of the surface: 0 to 1.
  struct FarPoint {
    std::size_t point;
    double part;
    FarBinding::Point binding;
  };

  SurfaceGradients gradients_;
  FarBinding far_;
  std::vector<Point> points_;
  std::vector<FarPoint> far_points_;
  double farthest_ = 0;
};

}  // namespace bem
