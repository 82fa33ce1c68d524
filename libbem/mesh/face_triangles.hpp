#pragma once

#include "base/types.hpp"

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace bem {

/// The triangles of one face with four or more corners, by the numbers of the corners (from 0).
///
/// The fan around corner 0 where it is fine: every triangle faces the side of the face and is no
/// sliver (height below 1e-4 of its longest edge), as in convex faces without straight corners. Of
/// other quads the better diagonal; of other faces the constrained Delaunay triangulation in the
/// plane across the face's normal. Where two diagonals are equally good up to 1e-4, as in
/// rectangles, the one with the lower corner is taken: rounding does not choose.
class FaceTriangles {
 public:
  using Diagonal = std::pair<int, int>;  ///< corners, the lower one first

  /// `points`: where the corners are [m], at least four, finite, in order, counter-clockwise for
  /// someone whom the face looks at; neighbours are in different places. `place[k]`: the first
  /// corner at the place of corner k. O(n log n).
  FaceTriangles(std::vector<Vec3> points, std::vector<int> place);

  /// Does the face cross or touch itself, seen along its normal, so that it has no triangles?
  bool crosses_itself() const { return triangles_.empty(); }
  const std::vector<Triangle>& triangles() const { return triangles_; }

  /// Edges between two of the triangles that are no edges of the face.
  std::vector<Diagonal> diagonals() const;
  /// What the two triangles at a diagonal would have instead; empty where they would turn over or
  /// become slivers.
  std::optional<Diagonal> other_diagonal(const Diagonal& diagonal) const;
  /// Replaces a diagonal by the other one, which there must be. O(log n).
  void flip(const Diagonal& diagonal);
  /// Puts the triangles into an order that does not depend on flips.
  void sort();

 private:
  void find_normal();
  void index_edges();
  bool is_inner(const Diagonal& edge) const;
  void cut_fan();
  void cut_quad();
  void cut_by_plane();
  void settle_ties();
  double quality(const Triangle& t) const;
  double worst_quality(const std::vector<Triangle>& triangles) const;
  bool is_fan_fine(const std::vector<Triangle>& fan) const;
  bool is_flat() const;
  bool is_line() const;
  bool is_tie(const Diagonal& diagonal) const;
  int opposite(int from, int to) const;

  std::vector<Vec3> points_;
  std::vector<int> place_;
  Vec3 normal_ = Vec3::Zero();  ///< unit normal, zero where the face has no area
  double size_ = 0;             ///< largest distance from corner 0 [m]
  std::vector<Triangle> triangles_;
  std::map<std::pair<int, int>, int> triangle_of_;  ///< directed edge -> triangle on its left
  std::vector<Diagonal> rim_;                       ///< the face's own edges, sorted
};

}  // namespace bem
