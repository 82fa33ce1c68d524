#include "collision/surface_overlap.hpp"
#include "collision_test.hpp"
#include "mesh/two_sided.hpp"

using namespace bem;
using namespace bem::test;

namespace {

constexpr double kTolerance = 1e-6;

double overlap_of(const TriangleMesh& a, const TriangleMesh& b) {
  const SignedDistance first(a.triangles, a.vertices), second(b.triangles, b.vertices);
  const double depth = surface_overlap(first, second, kTolerance);
  CHECK(surface_overlap(second, first, kTolerance) == Approx(depth));
  return depth;
}

TriangleMesh at(TriangleMesh mesh, const Vec3& place) {
  for (Vec3& v : mesh.vertices) v += place;
  return mesh;
}

const TriangleMesh kCube = box({1, 1, 1}, {2, 2, 2});

}  // namespace

TEST_CASE("surfaces that are apart or touch do not overlap") {
  CHECK(overlap_of(kCube, at(kCube, {1.5, 0, 0})) == 0);
  for (const Vec3& side : {Vec3(1, 0, 0), Vec3(1, 0.3, 0.2), Vec3(1, 1, 0), Vec3(1, 1, 1)})
    CHECK(overlap_of(kCube, at(kCube, side)) == 0);
  CHECK(overlap_of(kCube, at(kCube, {1 - 1e-7, 0, 0})) == 0);  // within the tolerance
  CHECK(overlap_of(icosphere(2, 0.5), at(icosphere(2, 0.5), {1, 0, 0})) == 0);
  CHECK(overlap_of(torus(1, 0.2, 40, 16), icosphere(2, 0.5)) == 0);  // in the hole
}

TEST_CASE("a vertex inside tells how deep") {
  CHECK(overlap_of(kCube, at(kCube, {0.9, 0.05, 0.03})) == Approx(0.1));
  CHECK(overlap_of(kCube, at(box({0.2, 0.2, 0.2}, {1, 1, 1}), {0, 0, 0.5})) == Approx(0.1));
}

TEST_CASE("bars that cross without a vertex in each other overlap") {
  const TriangleMesh bar = box({3, 0.2, 0.2}, {1, 1, 1}), other = box({0.2, 3, 0.2}, {1, 1, 1});
  CHECK(overlap_of(bar, at(other, {0, 0, 0.05})) == Approx(0.1).epsilon(0.3));
  // flush: no edge goes through the other's faces from outside
  CHECK(overlap_of(bar, other) > 0.05);
  CHECK(overlap_of(box({3, 0.2, 0.2}, {7, 2, 2}), box({0.2, 3, 0.2}, {2, 5, 2})) > 0.05);
}

TEST_CASE("a body within another and one at the place of another overlap") {
  CHECK(overlap_of(kCube, at(box({0.2, 0.2, 0.2}, {1, 1, 1}), {0.1, 0, 0})) == Approx(0.4));
  CHECK(overlap_of(kCube, kCube) > 0.3);
  CHECK(overlap_of(icosphere(2, 1), icosphere(2, 1)) > 1);
  CHECK(overlap_of(kCube, at(kCube, {0.5, 0, 0})) == Approx(0.5).epsilon(0.5));
  CHECK(overlap_of(kCube, at(box({0.5, 1, 1}, {1, 2, 2}), {0.25, 0, 0})) > 0.1);
}

TEST_CASE("what a sheet cuts of a body overlaps") {
  const TriangleMesh sheet{{{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}},
                           {{0, 1, 2}, {0, 2, 3}}};
  const TriangleMesh layers = make_two_sided(sheet).layers;
  CHECK(overlap_of(at(kCube, {0.2, 0.1, 0.3}), layers) == Approx(0.2));
  CHECK(overlap_of(at(kCube, {0, 0, 0.5}), layers) == 0);
  CHECK(overlap_of(at(kCube, {0, 0, -0.51}), layers) == 0);
}

TEST_CASE("bodies at one place overlap although their coordinates are rounded") {
  for (double edge : {1.0, 0.6, 0.3, 0.2, 0.1, 0.05})
    for (const Vec3& place : {Vec3(0, 0, 0), Vec3(0.1, 0.7, -0.3)}) {
      const TriangleMesh cube = at(box({edge, edge, edge}, {2, 2, 2}), place);
      CHECK(overlap_of(cube, cube) > 0.2 * edge);
      TriangleMesh turned = cube;  // by a quarter about the vertical through its centre
      for (Vec3& v : turned.vertices) {
        const Vec3 d = v - place;
        v = place + Vec3(-d[1], d[0], d[2]);
      }
      CHECK(overlap_of(cube, turned) > 0.2 * edge);
    }
}
