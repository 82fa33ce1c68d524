#pragma once

#include "mesh/shapes.hpp"
#include "mesh/triangle_mesh.hpp"

#include <utility>

namespace bem::test {

/// Every triangle with vertices of its own.
inline TriangleMesh soup_of(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const Triangle& t : mesh.triangles) {
    const int n = static_cast<int>(soup.vertices.size());
    for (int v : t) soup.vertices.push_back(mesh.vertices[v]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  return soup;
}

/// Every third triangle turned over.
inline TriangleMesh shuffled(TriangleMesh mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  return mesh;
}

inline TriangleMesh without(TriangleMesh mesh, std::size_t first, std::size_t count) {
  const auto begin = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first);
  mesh.triangles.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
  return mesh;
}

inline TriangleMesh both(TriangleMesh a, const TriangleMesh& b, const Vec3& shift) {
  const int n = static_cast<int>(a.vertices.size());
  for (const Vec3& v : b.vertices) a.vertices.push_back(v + shift);
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({n + i, n + j, n + k});
  return a;
}

inline TriangleMesh cube() {
  return box({1, 1, 1}, {1, 1, 1});
}

/// Flat grid of n x n unit cells in the plane z = 0.
inline TriangleMesh grid(int n) {
  TriangleMesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) mesh.vertices.emplace_back(i, j, 0);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

}  // namespace bem::test
