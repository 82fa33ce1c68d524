#pragma once

#include "base/types.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace bem {

/// What two triangles have in common.
enum class Adjacency { none, vertex, edge, identical };  // by the number of corners

/// A point of the product of two triangles, by barycentric coordinates, and its weight as a part of
/// the product of their areas.
struct PairPoint {
  double x[3], y[3], weight;
};

/// Two triangles that touch: the corners that they share come first in both, in the same order.
struct TouchingTriangles {
  Adjacency adjacency;
  std::array<Vec3, 3> x, y;
};

/// How fine a rule for touching triangles is.
struct TouchingAccuracy {
  /// Gauss points away from what is shared, and in the other directions in which |x - y| is a
  /// factor times what does not depend on them. Static kernels times shape functions are
  /// polynomials there: 3 and 2 points are exact for them.
  int away, along;
  /// Error aimed at in the directions in which |x - y| changes otherwise, relative to the integral.
  double tolerance;
};

/// Quadrature for kernels up to 1/r^2 (as Cauchy principal values) over two triangles that touch,
/// by the transformations of Sauter and Schwab (Boundary Element Methods, 5.2). Each of the
/// directions that are left (three about a vertex, two about an edge, one in the same triangle) has
/// as many Gauss points as the nearest zero of |x - y|^2 at a complex coordinate demands; where
/// these are too many, as beside slender triangles, the direction is halved. Points of which many
/// have the same x or the same y stand one after another. They come in `points`, which is
/// overwritten: `give` is called for each hundred thousand of them, and for the rest.
void touching_rule(const TouchingTriangles& pair, const TouchingAccuracy& accuracy,
                   std::vector<PairPoint>& points, const std::function<void()>& give);

/// How many points they are; a number beyond `most` if they are more.
std::size_t touching_rule_size(const TouchingTriangles& pair, const TouchingAccuracy& accuracy,
                               std::size_t most);

}  // namespace bem
