#pragma once

#include "base/types.hpp"

#include <array>

namespace bem {

/// A part of a triangle: it or a half of another part.
class TriangleCell {
 public:
  /// The whole triangle with these corners.
  explicit TriangleCell(const std::array<Vec3, 3>& corners);

  /// One half of it, 0 or 1: the longest edge is cut, which leaves fewer slivers of slivers than
  /// other cuts.
  TriangleCell half(int index) const;

  bool is_whole() const { return part_ == 1; }
  double part() const { return part_; }             ///< of the triangle's area
  double longest_edge() const { return longest_; }  ///< [m]
  const std::array<Vec3, 3>& corners() const { return corners_; }

  /// The place of barycentric coordinates in the cell.
  Vec3 position(const double* l) const {
    return l[0] * corners_[0] + l[1] * corners_[1] + l[2] * corners_[2];
  }
  /// Barycentric coordinates in the triangle of those in the cell.
  void to_triangle(const double* in_cell, double* in_triangle) const {
    for (int a = 0; a < 3; ++a)
      in_triangle[a] = in_cell[0] * barycentric_[0][a] + in_cell[1] * barycentric_[1][a] +
                       in_cell[2] * barycentric_[2][a];
  }
  /// The six shape functions of the triangle (quadratic_shapes) by those of the cell: row a has the
  /// coefficients of shape a. The first three by the first three are the linear ones.
  Eigen::Matrix<double, 6, 6> shapes() const;

 private:
  double length(int edge) const { return (corners_[(edge + 1) % 3] - corners_[edge]).norm(); }
  void measure();

  std::array<Vec3, 3> corners_;
  std::array<std::array<double, 3>, 3> barycentric_ = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  int longest_side_ = 0;  ///< from which corner on
  double longest_ = 0, part_ = 1;
};

}  // namespace bem
