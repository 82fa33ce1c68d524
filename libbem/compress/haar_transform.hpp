#pragma once

#include <vector>

namespace bem {

/// One step of a Haar transform: the means of two neighbouring ranges of points, as orthonormal
/// coefficients at the places `left` and `right`, become that of both at `left` and their
/// difference at `right`.
struct HaarStep {
  int left = 0, right = 0;                   ///< first points of the ranges
  double left_weight = 0, right_weight = 0;  ///< square roots of their parts of the points
};

/// The steps, finest first, for the ranges of more than `leaf` points that first_half()
/// (mesh/bisection.hpp) cuts [0, count) into. With leaf 1 they are an orthonormal transform in
/// place for any `count`; for a power of two it is the usual Haar transform, in another order: the
/// difference across a cut has the number of the first point behind it, the mean of all number 0.
std::vector<HaarStep> haar_steps(int count, int leaf = 1);

/// First points of the ranges of at most `leaf` points that are left whole, and `count`.
std::vector<int> haar_ranges(int count, int leaf);

/// The coefficients of a vector, in its place.
template <class T>
void haar_analyse(const std::vector<HaarStep>& steps, T* x) {
  for (const HaarStep& s : steps) {
    const T left = x[s.left], right = x[s.right];
    const T a = static_cast<T>(s.left_weight), b = static_cast<T>(s.right_weight);
    x[s.left] = a * left + b * right;
    x[s.right] = b * left - a * right;
  }
}

/// The vector that has these coefficients: the transposed and inverse transform.
template <class T>
void haar_synthesise(const std::vector<HaarStep>& steps, T* x) {
  for (auto s = steps.rbegin(); s != steps.rend(); ++s) {
    const T mean = x[s->left], difference = x[s->right];
    const T a = static_cast<T>(s->left_weight), b = static_cast<T>(s->right_weight);
    x[s->left] = a * mean + b * difference;
    x[s->right] = b * mean - a * difference;
  }
}

}  // namespace bem
