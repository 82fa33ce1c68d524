#include "mesh/adjacency.hpp"
#include "mesh/mass_properties.hpp"
#include "mesh/self_intersection.hpp"
#include "mesh/shapes.hpp"
#include "mesh/surface.hpp"
#include "mesh_test.hpp"

#include <algorithm>

using namespace bem;

namespace {

/// Checks that the mesh is valid without a warning and outward, and returns its volume.
double checked_volume(const TriangleMesh& mesh, int euler_characteristic = 2) {
  const Surface surface = make_surface(mesh, "shape");
  for (const std::string& warning : surface.warnings) FAIL_CHECK(warning);
  CHECK(surface.nodes.vertices.size() == mesh.vertices.size());
  CHECK(surface.nodes.triangles == mesh.triangles);
  const int vertices = static_cast<int>(mesh.vertices.size());
  const int triangles = static_cast<int>(mesh.triangles.size());
  CHECK(vertices - triangles * 3 / 2 + triangles == euler_characteristic);
  return mass_properties(mesh, 1.0).volume;
}

double smallest_height_ratio(const TriangleMesh& mesh) {
  double smallest = 1;
  for (const Triangle& t : mesh.triangles) smallest = std::min(smallest, height_ratio(mesh, t));
  return smallest;
}

}  // namespace

TEST_CASE("icosphere: vertices on the sphere, volume of second order") {
  double error[2];
  for (int s : {2, 3}) {
    const TriangleMesh mesh = icosphere(s, 0.5);
    CHECK(mesh.vertices.size() == static_cast<std::size_t>(10 * (1 << (2 * s)) + 2));
    for (const Vec3& v : mesh.vertices) REQUIRE(v.norm() == Approx(0.5).epsilon(1e-14));
    error[s - 2] = kPi / 6.0 - checked_volume(mesh);
  }
  CHECK(error[1] > 0);
  CHECK(error[0] / error[1] == Approx(4.0).epsilon(0.05));
}

TEST_CASE("box: exact volume and extent, also graded, and a mirror symmetric pattern") {
  for (double grading : {0.0, 0.5, 1.0}) {
    const TriangleMesh mesh = box({2, 1, 0.5}, {8, 4, 3}, grading);
    CHECK(checked_volume(mesh) == Approx(1.0).epsilon(1e-13));
    CHECK(mesh.triangles.size() == 4 * (8 * 4 + 4 * 3 + 3 * 8));
    const BoundingBox extent = bounding_box(mesh.vertices);
    CHECK(extent.min == Vec3(-1, -0.5, -0.25));
    CHECK(extent.max == Vec3(1, 0.5, 0.25));
  }
  // The cells at the ends of a fully graded axis are smaller than the middle ones.
  const TriangleMesh graded = box({2, 1, 1}, {8, 1, 1}, 1.0);
  CHECK(graded.vertices[1][0] - graded.vertices[0][0] <
        0.3 * (graded.vertices[4][0] - graded.vertices[3][0]));

  const TriangleMesh mesh = box({1, 1, 1}, {4, 4, 4});
  const auto centroids = [&](int mirrored_axis) {
    std::vector<std::array<long, 3>> result;
    for (const Triangle& t : mesh.triangles) {
      Vec3 c = triangle_centroid(mesh, t);
      if (mirrored_axis >= 0) c[mirrored_axis] *= -1;
      result.push_back({std::lround(c[0] * 1e6), std::lround(c[1] * 1e6), std::lround(c[2] * 1e6)});
    }
    std::sort(result.begin(), result.end());
    return result;
  };
  for (int axis = 0; axis < 3; ++axis) CHECK(centroids(axis) == centroids(-1));
}

TEST_CASE("torus: genus one and Pappus' volume") {
  const TriangleMesh mesh = torus(1.0, 0.3, 120, 60);
  CHECK(checked_volume(mesh, 0) == Approx(2 * kPi * kPi * 0.09).epsilon(3e-3));
}

TEST_CASE("cylinder: volume of the prism over its regular polygon, well shaped caps") {
  for (int segments : {3, 5, 6, 17, 64}) {
    const TriangleMesh mesh = cylinder(0.5, 2.0, segments, std::max(2, segments / 2));
    const double polygon = 0.5 * segments * 0.25 * std::sin(2 * kPi / segments);
    CHECK(checked_volume(mesh) == Approx(2.0 * polygon).epsilon(1e-12));
    if (segments >= 6) CHECK(smallest_height_ratio(mesh) > 0.3);
  }
}

TEST_CASE("bumpy cube: smooth, within its size, bumps change the volume little") {
  const TriangleMesh plain = bumpy_cube(1.0, 12, 0.0);
  const BoundingBox extent = bounding_box(plain.vertices);
  CHECK(extent.max.isApprox(Vec3::Constant(0.5), 1e-12));
  CHECK(extent.min.isApprox(Vec3::Constant(-0.5), 1e-12));
  // |x|^4 + |y|^4 + |z|^4 <= 1/16: volume Gamma(5/4)^3 / Gamma(7/4).
  const double exact = std::pow(std::tgamma(1.25), 3) / std::tgamma(1.75);
  CHECK(checked_volume(plain) == Approx(exact).epsilon(0.02));
  const TriangleMesh bumpy = bumpy_cube(1.0, 16, 0.3);
  CHECK(checked_volume(bumpy) == Approx(exact).epsilon(0.1));
  CHECK(std::abs(checked_volume(bumpy) - checked_volume(bumpy_cube(1.0, 16, 0.0))) > 1e-4);
}

TEST_CASE("bowl: closed, thick, of the volume of half a shell") {
  const TriangleMesh mesh = bowl(1.0, 0.2, 96);
  const double exact = 2.0 / 3.0 * kPi * (1.0 - 0.8 * 0.8 * 0.8);
  CHECK(checked_volume(mesh) == Approx(exact).epsilon(5e-3));
  CHECK(bounding_box(mesh.vertices).max[2] == 0.0);
  CHECK(bounding_box(mesh.vertices).min[2] == -1.0);
  CHECK(checked_volume(bowl(0.3, 0.02, 24)) > 0);
}

TEST_CASE("star: radii fill their range") {
  const TriangleMesh mesh = star(3, 2.0);
  double smallest = 10, largest = 0;
  for (const Vec3& v : mesh.vertices) {
    smallest = std::min(smallest, v.norm());
    largest = std::max(largest, v.norm());
  }
  CHECK(smallest == Approx(1.3).epsilon(1e-12));
  CHECK(largest == Approx(2.7).epsilon(1e-12));
  CHECK(checked_volume(mesh) > 10);
}

TEST_CASE("notched cube: seven eighths of a cube") {
  for (int divisions : {2, 4, 10})
    CHECK(checked_volume(notched_cube(2.0, divisions)) == Approx(7.0).epsilon(1e-13));
  for (const Vec3& v : notched_cube(2.0, 4).vertices) CHECK_FALSE(v.minCoeff() > 1e-12);
}

TEST_CASE("fish: closed, symmetric in its number of vertices, well shaped, flat and forked") {
  for (int segments : {8, 14, 30, 60}) {
    const TriangleMesh mesh = fish(0.5, segments);
    checked_volume(mesh);
    CHECK(find_self_intersections(mesh).count == 0);
    CHECK(mesh.vertices.size() > 0.6 * segments * segments);
    CHECK(mesh.vertices.size() < 1.1 * segments * segments);
  }
  const TriangleMesh mesh = fish(1, 60);
  CHECK(checked_volume(mesh) == Approx(checked_volume(fish(1, 90))).epsilon(0.01));
  CHECK(smallest_height_ratio(mesh) > 0.01);
  const Vec3 size = bounding_box(mesh.vertices).max - bounding_box(mesh.vertices).min;
  CHECK(size[0] == Approx(1).epsilon(0.1));
  CHECK(size[1] < 0.7 * size[2]);
  // the tips of the tail are behind its middle
  double tip = 1, middle = 1;
  for (const Vec3& v : mesh.vertices) {
    if (v[2] > 0.12) tip = std::min(tip, v[0]);
    if (std::abs(v[2]) < 0.02) middle = std::min(middle, v[0]);
  }
  CHECK(tip < middle - 0.05);
}

TEST_CASE("clip: the volume of its box without the gap") {
  const TriangleMesh mesh = clip({10, 7, 3}, 2, 0.1);
  CHECK(checked_volume(mesh) == Approx(1.0 * 0.7 * 0.3 - 0.8 * 0.3 * 0.3).epsilon(1e-12));
  CHECK(bounding_box(mesh.vertices).max.isApprox(Vec3(0.5, 0.35, 0.15), 1e-12));
  for (const Vec3& v : mesh.vertices) CHECK_FALSE((v[0] > -0.29 && std::abs(v[1]) < 0.14));
}

TEST_CASE("random tetrahedra: valid, different, the same for the same seed") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const TriangleMesh mesh = random_tetrahedron(seed);
    CHECK(checked_volume(mesh) >= 0.05);
    CHECK(mesh.vertices == random_tetrahedron(seed).vertices);
    CHECK(mesh.vertices != random_tetrahedron(seed + 1).vertices);
  }
  // The first accepted draw of splitmix64 started at 14.
  CHECK(random_tetrahedron(14).vertices[0] ==
        Vec3(0.4166539954511417, 0.07130586937062144, 0.014932476591978494));
}

TEST_CASE("shapes refuse parameters out of range as usage errors") {
  const std::function<void()> calls[] = {[] { icosphere(-1, 1); },
                                         [] { icosphere(10, 1); },
                                         [] { icosphere(1, 0); },
                                         [] {
                                           box({1, 0, 1}, {1, 1, 1});
                                         },
                                         [] {
                                           box({1, 1, 1}, {1, 0, 1});
                                         },
                                         [] {
                                           box({1, 1, 1}, {1, 1, 1}, 1.5);
                                         },
                                         [] { torus(1, 1, 8, 8); },
                                         [] { torus(1, 0.5, 2, 8); },
                                         [] { cylinder(1, -1, 8, 1); },
                                         [] { cylinder(1, 1, 2, 1); },
                                         [] { bumpy_cube(1, 0, 0.1); },
                                         [] { bumpy_cube(1, 4, 1.0); },
                                         [] { bowl(1, 1, 8); },
                                         [] { star(2, std::nan("")); },
                                         [] { fish(0, 20); },
                                         [] { fish(1, 7); },
                                         [] {
                                           clip({4, 4, 1}, 2, 0.1);
                                         },
                                         [] {
                                           clip({4, 5, 1}, 2, 0);
                                         },
                                         [] { notched_cube(1, 3); }};
  for (const auto& call : calls)
    CHECK_THAT(test::error_message(ErrorCode::usage, call), Catch::Matchers::StartsWith("shape: "));
}
