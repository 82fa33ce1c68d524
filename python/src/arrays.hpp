#pragma once

#include "base/types.hpp"

#include <cstring>
#include <vector>

#include <pybind11/numpy.h>

namespace bem::python {

/// Arrays as numpy has them, converted where that loses nothing.
using Doubles = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;
using Ints = pybind11::array_t<int, pybind11::array::c_style | pybind11::array::forcecast>;

/// n x 3.
inline pybind11::array_t<double> array_of(const std::vector<Vec3>& vectors) {
  pybind11::array_t<double> out(
      {static_cast<pybind11::ssize_t>(vectors.size()), pybind11::ssize_t{3}});
  if (!vectors.empty())
    std::memcpy(out.mutable_data(), vectors.data()->data(), vectors.size() * sizeof(Vec3));
  return out;
}

inline pybind11::array_t<int> array_of(const std::vector<Triangle>& triangles) {
  pybind11::array_t<int> out(
      {static_cast<pybind11::ssize_t>(triangles.size()), pybind11::ssize_t{3}});
  if (!triangles.empty())
    std::memcpy(out.mutable_data(), triangles.data(), triangles.size() * sizeof(Triangle));
  return out;
}

inline pybind11::array_t<double> array_of(const Vec3& v) {
  return pybind11::array_t<double>(3, v.data());
}

inline pybind11::array_t<double> array_of(const Mat3& m) {
  pybind11::array_t<double> out({3, 3});
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out.mutable_at(i, j) = m(i, j);
  return out;
}

/// Of the points of an n x 3 array.
inline std::vector<Vec3> points_of(const Doubles& array) {
  std::vector<Vec3> out(static_cast<std::size_t>(array.shape(0)));
  if (!out.empty()) std::memcpy(out.data()->data(), array.data(), out.size() * sizeof(Vec3));
  return out;
}

inline std::vector<Triangle> triangles_of(const Ints& array) {
  std::vector<Triangle> out(static_cast<std::size_t>(array.shape(0)));
  if (!out.empty()) std::memcpy(out.data(), array.data(), out.size() * sizeof(Triangle));
  return out;
}

}  // namespace bem::python
