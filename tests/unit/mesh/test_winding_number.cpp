#include "mesh/shapes.hpp"
#include "mesh/winding_number.hpp"
#include "mesh_test.hpp"

#include <algorithm>

using namespace bem;

namespace {

const TriangleMesh kAround = box({1, 1, 1}, {2, 2, 2});

double around(const TriangleMesh& mesh, const Vec3& p) {
  return winding_number(mesh.triangles, mesh.vertices, p);
}

}  // namespace

TEST_CASE("a triangle covers the solid angle of its closed form") {
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), origin = Vec3::Zero();
  // an octant of the sphere, whatever the lengths of the edges
  CHECK(solid_angle(origin, x, y, z) == Approx(kPi / 2).epsilon(1e-15));
  CHECK(solid_angle(origin, 2 * x, 30 * y, 0.1 * z) == Approx(kPi / 2).epsilon(1e-14));
  CHECK(solid_angle(origin, x, z, y) == Approx(-kPi / 2).epsilon(1e-15));
  // half of the face of a cube, seen from its centre
  CHECK(solid_angle(origin, {1, -1, -1}, {1, 1, -1}, {1, 1, 1}) == Approx(kPi / 3).epsilon(1e-14));
  // half of a square of width 1 whose corner is at distance h: asin(1 / (1 + h^2)) for all of it
  for (double h : {0.01, 0.5, 20.0}) {
    const double half = 0.5 * std::asin(1 / (1 + h * h));
    CHECK(solid_angle({0, 0, -h}, origin, x, x + y) == Approx(half).epsilon(1e-10));
  }
  // from afar: area over square of the distance
  const double far = 1e6;
  CHECK(solid_angle({0, 0, -far}, origin, x, y) == Approx(0.5 / (far * far)).epsilon(1e-5));
}

TEST_CASE("a triangle covers half of the view on its face and nothing in its plane") {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  CHECK(solid_angle({0.3, 0.3, -1e-12}, a, b, c) == Approx(2 * kPi).epsilon(1e-10));
  CHECK(solid_angle({0.3, 0.3, 1e-12}, a, b, c) == Approx(-2 * kPi).epsilon(1e-10));
  CHECK(solid_angle({3, 3, 0}, a, b, c) == 0);
}

TEST_CASE("the winding number is 1 inside and 0 outside") {
  CHECK(around(kAround, {0.1, 0.2, -0.3}) == Approx(1.0).epsilon(1e-12));
  CHECK(std::abs(around(kAround, {0.1, 0.2, 0.8})) < 1e-12);
  CHECK(around(kAround, {0.1, 0.2, 0.5 - 1e-9}) == Approx(1.0).epsilon(1e-6));
  CHECK(std::abs(around(kAround, {0.1, 0.2, 0.5 + 1e-9})) < 1e-6);
  CHECK(around(icosphere(2, 1), Vec3::Zero()) == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("the winding number counts surfaces with their orientation") {
  const Vec3 p(0.01, 0.02, 0.03);
  const TriangleMesh inward = test::combined({}, kAround, 1.0, Vec3::Zero(), true);
  CHECK(around(inward, p) == Approx(-1.0).epsilon(1e-12));
  CHECK(around(test::combined(kAround, kAround, 0.5, Vec3::Zero(), false), p) ==
        Approx(2.0).epsilon(1e-12));
  CHECK(std::abs(around(test::combined(kAround, kAround, 0.5, Vec3::Zero(), true), p)) < 1e-12);
  TriangleMesh open = kAround;  // without one of its six faces, seen from the centre
  open.triangles.erase(
      std::remove_if(open.triangles.begin(), open.triangles.end(),
                     [&](const Triangle& t) { return triangle_centroid(open, t)[2] > 0.499; }),
      open.triangles.end());
  CHECK(around(open, Vec3::Zero()) == Approx(5.0 / 6).epsilon(1e-12));
}
