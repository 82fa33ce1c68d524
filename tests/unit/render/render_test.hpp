#pragma once

#include "mesh/extent.hpp"
#include "mesh/shapes.hpp"
#include "render/surface_binding.hpp"

#include <functional>
#include <string>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

namespace bem::test {

using Motion3 = std::function<Vec3(const Vec3&)>;

/// A surface, and a finer mesh of the same body.
struct MeshPair {
  std::string name;
  TriangleMesh surface, fine;
};

inline std::vector<MeshPair> mesh_pairs() {
  return {{"spheres", icosphere(2, 0.5), icosphere(4, 0.5)},
          {"tori", torus(0.5, 0.2, 24, 12), torus(0.5, 0.2, 97, 41)},
          {"fish", fish(1, 16), fish(1, 48)},
          {"boxes", box({1, 0.6, 0.4}, {6, 4, 3}), box({1, 0.6, 0.4}, {20, 13, 9})},
          {"plates", box({1, 1, 0.05}, {8, 8, 1}), box({1, 1, 0.05}, {31, 31, 3})},
          {"stars", star(3, 0.5), star(4, 0.5)},
          {"bowls", bowl(0.5, 0.05, 24), bowl(0.5, 0.05, 60)}};
}

/// The mesh with its vertices moved outward.
inline TriangleMesh inflated(TriangleMesh mesh, double by) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (const Triangle& t : mesh.triangles)
    for (int v : t) normals[v] += area_vector(mesh, t);
  for (std::size_t v = 0; v < normals.size(); ++v) mesh.vertices[v] += by * normals[v].normalized();
  return mesh;
}

/// Meshes with sharp edges and surfaces at a distance from them, outside or inside.
inline std::vector<MeshPair> wrapped_pairs() {
  return {{"wrapped notch", inflated(notched_cube(1, 8), 0.04), notched_cube(1, 20)},
          {"notch around", inflated(notched_cube(1, 8), -0.04), notched_cube(1, 20)},
          {"wrapped clip", inflated(clip({20, 10, 4}, 2, 0.05), 0.03), clip({40, 20, 8}, 4, 0.025)},
          {"wrapped box", inflated(box({1, 0.6, 0.4}, {6, 4, 3}), 0.05),
           box({1, 0.6, 0.4}, {20, 13, 9})}};
}

/// Meshes that are inside of the surface and far from it.
inline std::vector<MeshPair> inner_pairs() {
  return {{"sphere in box", box({1, 0.6, 0.4}, {6, 4, 3}), icosphere(4, 0.19)},
          {"small sphere in sphere", icosphere(2, 0.5), icosphere(2, 0.05)},
          {"box in sphere", icosphere(3, 0.5), box({0.4, 0.4, 0.4}, {8, 8, 8})}};
}

inline std::vector<Vec3> moved(const std::vector<Vec3>& points, const Motion3& motion) {
  std::vector<Vec3> out;
  for (const Vec3& x : points) out.push_back(motion(x));
  return out;
}

/// Where the bound points are when the surface moves.
inline std::vector<Vec3> bound_points(const SurfaceBinding& binding, const TriangleMesh& surface,
                                      const Motion3& motion) {
  return binding.points(binding.pose(moved(surface.vertices, motion)));
}

inline double largest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

/// Motions that strain by up to 30 %, by name.
inline std::vector<std::pair<std::string, Motion3>> strong_motions() {
  const auto bend = [](const Vec3& x) {  // about y, 30 % at a distance of 0.5 from the x axis
    const double r = 0.5 / 0.3, a = x[0] / r;
    return Vec3((r - x[2]) * std::sin(a), x[1], r - (r - x[2]) * std::cos(a));
  };
  const auto twist = [](const Vec3& x) {  // 60 % of shear at a distance of 0.5 from the x axis
    return Vec3(Eigen::AngleAxisd(1.2 * x[0], Vec3::UnitX()) * x);
  };
  const auto stretch = [](const Vec3& x) { return Vec3(1.3 * x[0], 0.7 * x[1], x[2]); };
  const auto waves = [](const Vec3& x) {  // slopes of up to 0.3
    return Vec3(x[0], x[1] + 0.03 * std::sin(10 * x[0]), x[2] + 0.03 * std::sin(10 * x[1]));
  };
  return {{"bend", bend}, {"twist", twist}, {"stretch", stretch}, {"waves", waves}};
}

/// Triangles of the fine mesh that look the other way than the motion of their middle makes them.
inline std::size_t folds(const TriangleMesh& mesh, const std::vector<Vec3>& after,
                         const Motion3& motion) {
  constexpr double kStep = 1e-4;  // of difference quotients [m]
  std::size_t count = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 x = triangle_centroid(mesh, t), n = triangle_normal(mesh, t);
    const Vec3 e = n.unitOrthogonal(), f = n.cross(e);
    const Vec3 expected = (motion(x + kStep * e) - motion(x - kStep * e))
                              .cross(motion(x + kStep * f) - motion(x - kStep * f));
    if (area_vector(after[t[0]], after[t[1]], after[t[2]]).dot(expected) <= 0) ++count;
  }
  return count;
}

}  // namespace bem::test
