#pragma once

#include "base/state_archive.hpp"
#include "mesh/triangle_mesh.hpp"

#include <limits>
#include <vector>

namespace bem {

/// The extreme of a quantity over a run, and where and when it was first met.
struct Extreme {
  double value = 1;
  double time = 0;    ///< [s]
  int triangle = -1;  ///< of the nodes' mesh; -1: of the whole body, or never other than at rest

  void visit_state(StateArchive& state) { state(value, time, triangle); }
};

/// Follows how far the surface of a body is from its rest shape, as seen from the body's frame.
/// Linear elasticity in a frame holds for small strains and small rotations against the frame, and
/// says nothing when they are not: it lets a body swell, or turns it inside out.
///
/// * Ratio of the enclosed volume to that at rest.
/// * Ratio of the area of each triangle to that at rest.
/// * Rotation of each triangle against the frame [rad]: the rotation R of the polar decomposition
///   F = R U of the deformation gradient that maps the triangle, and its unit normal to its unit
///   normal.
/// * Inversion: a triangle is inverted when it has gone through zero area an odd number of times.
///   In a step its normal then turns by more than 90 degrees, which no rotation does.
///
/// A body is inside out when its enclosed volume is not positive, or kMostInverted of its surface
/// is inverted. One step is O(triangles), about 0.1 us for each.
class DeformationWatch {
 public:
  /// Beyond these a deformation is not one that the model can describe. Of areas and rotations it
  /// is what a share of the surface does, by area at rest: single triangles of a bad mesh and
  /// points of contact may do more.
  static constexpr double kLeastVolume = 2.0 / 3, kMostVolume = 1.5;
  static constexpr double kLeastArea = 0.5, kMostArea = 2;
  static constexpr double kMostRotation = kPi / 4;  ///< [rad]
  static constexpr double kLargestShare = 0.01;
  static constexpr double kMostInverted = 0.05;

  /// One more state: the vertices as seen from the frame, at the time [s]. Always the same mesh.
  void record(const TriangleMesh& rest, const std::vector<Vec3>& vertices, double time);

  const Extreme& least_volume() const { return least_volume_; }
  const Extreme& most_volume() const { return most_volume_; }
  const Extreme& least_area() const { return least_area_; }
  const Extreme& most_area() const { return most_area_; }
  const Extreme& rotation() const { return rotation_; }
  /// Shares of the surface, by area at rest.
  const Extreme& turned() const { return turned_; }
  const Extreme& stretched() const { return stretched_; }
  const Extreme& inverted() const { return inverted_share_; }
  /// When a limit was first exceeded [s]; infinite if none was.
  double beyond_since() const { return beyond_since_; }
  /// Is the body inverted in the last state?
  bool is_inside_out() const { return inside_out_; }
  bool was_inside_out() const { return was_inside_out_; }

  void visit_state(StateArchive& state) {
    state(least_volume_, most_volume_, least_area_, most_area_, rotation_, turned_, stretched_,
          inverted_share_, inside_out_, was_inside_out_);
    state.any_numbers(beyond_since_);
    state.resizable(normals_, inverted_);  // empty before the first state
    state.check(normals_.cols() == static_cast<Eigen::Index>(inverted_.size()));
  }

 private:
  Extreme least_volume_, most_volume_, least_area_, most_area_, rotation_{0, 0, -1};
  Extreme turned_{0, 0, -1}, stretched_{0, 0, -1}, inverted_share_{0, 0, -1};
  double beyond_since_ = std::numeric_limits<double>::infinity();
  bool inside_out_ = false, was_inside_out_ = false;
  Eigen::Matrix3Xd normals_;    ///< by triangle, of the last step
  std::vector<char> inverted_;  ///< by triangle
};

}  // namespace bem
