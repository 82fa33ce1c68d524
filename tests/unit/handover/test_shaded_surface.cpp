#include "handover/shaded_surface.hpp"
#include "sample_scene.hpp"

#include <algorithm>

#include <catch2/catch.hpp>

using namespace bem;

TEST_CASE("edges of a cube are creases") {
  const AnimatedScene scene = test::sample_scene();
  const std::vector<double> points = scene.positions(0, 0);
  const ShadedSurface surface(scene.bodies[0], points);
  CHECK(surface.size() == 24);
  CHECK(surface.corners().size() == 36);
  const std::vector<double> at = surface.at_vertices(points), normals = surface.normals(points);
  for (std::size_t v = 0; v < 24; ++v) {
    const Eigen::Map<const Vec3> n(normals.data() + 3 * v), x(at.data() + 3 * v);
    CHECK(n.cwiseAbs().maxCoeff() == Approx(1));
    CHECK(n.dot(x - Vec3::Constant(0.5)) == Approx(0.5));
  }
  const std::vector<float> uvs = surface.uvs();
  CHECK(std::count(uvs.begin(), uvs.end(), 0.75F) == 1);  // v = 0.25 downwards
}

TEST_CASE("a surface without creases keeps its vertices, but for seams of texture coordinates") {
  AnimatedBody roof;  // two triangles with an edge of 30 degrees
  roof.vertices = 4;
  roof.corners = {0, 1, 2, 2, 1, 3};
  roof.starts = {0, 3, 6};
  const std::vector<double> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, -0.4};
  const ShadedSurface plain(roof, points);
  CHECK(plain.size() == 4);
  CHECK_FALSE(plain.has_uvs());
  const std::vector<double> normals = plain.normals(points);
  CHECK(normals[3] == normals[6]);
  roof.uvs = {{0, 0}, {1, 0}};
  roof.corner_uvs = {0, 0, 0, 1, 1, 1};
  const ShadedSurface seam(roof, points);
  CHECK(seam.size() == 6);
  // normals do not see the seam
  const std::vector<double> beside = seam.normals(points);
  CHECK(std::count(beside.begin(), beside.end(), normals[3]) >= 4);
}

TEST_CASE("vertices without a face are left out, and folded triangles have normals") {
  AnimatedBody body;
  body.vertices = 5;
  body.corners = {0, 1, 4, 1, 1, 4};
  body.starts = {0, 3, 6};
  const std::vector<double> points{0, 0, 0, 1, 0, 0, 9, 9, 9, 9, 9, 9, 0, 1, 0};
  const ShadedSurface surface(body, points);
  for (double x : surface.at_vertices(points)) CHECK(x <= 1);
  const std::vector<double> normals = surface.normals(points);
  for (std::size_t v = 0; v < surface.size(); ++v)
    CHECK(Eigen::Map<const Vec3>(normals.data() + 3 * v).norm() == Approx(1));
}
