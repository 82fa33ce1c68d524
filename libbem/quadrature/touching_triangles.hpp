#pragma once

#include <vector>

namespace bem {

/// What two triangles have in common.
enum class Adjacency { none, vertex, edge, identical };  // by the number of corners

/// A point of the product of two triangles, by barycentric coordinates, and its weight as a part of
/// the product of their areas.
struct PairPoint {
  double x[3], y[3], weight;
};

/// Quadrature for kernels up to 1/r^2 (as Cauchy principal values) over two triangles that touch:
/// the corners that they share come first in both, in the same order. The transformations of Sauter
/// and Schwab (Boundary Element Methods, 5.2) with `radial` Gauss points in the direction away from
/// what is shared, in which static kernels times shape functions are polynomials, and n in each of
/// the three others: 6, 5 or 2 radial n^3 points. Points of which n or n^2 have the same x or the
/// same y stand one after another.
std::vector<PairPoint> touching_rule(Adjacency adjacency, int n, int radial);

}  // namespace bem
