#include "assembly/pair_quadrature.hpp"

#include <catch2/catch.hpp>

using namespace bem;

namespace {

/// Two triangles with edges of 1 and heights of `height`, one `distance` above the other and turned
/// about their common normal by half a turn.
TriangleMesh two_slivers(double height, double distance) {
  TriangleMesh mesh;
  mesh.vertices = {Vec3(0, 0, 0),        Vec3(1, 0, 0),        Vec3(0.4, height, 0),
                   Vec3(1, 0, distance), Vec3(0, 0, distance), Vec3(0.5, -height, distance)};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  return mesh;
}

struct Sums {
  int points = 0;
  double areas = 0, potential = 0;  ///< of 1 and of 1/r
};

Sums sums_of(const TriangleMesh& mesh, int tx, int ty, double tolerance) {
  const PairQuadrature quadrature(mesh, tolerance, 0);
  Sums out;
  quadrature.for_each_point(
      tx, ty, KernelPart::static_part, PairShare::all, [&](const PairPoint& p) {
        ++out.points;
        out.areas += p.weight;
        out.potential +=
            p.weight / (quadrature.position(tx, p.x) - quadrature.position(ty, p.y)).norm();
      });
  return out;
}

}  // namespace

TEST_CASE("close slivers are cut along, not across") {
  const Sums exact = sums_of(two_slivers(0.04, 0.04), 0, 1, 1e-9);
  int points = 0;
  for (const double height : {0.04, 0.02, 0.01}) {
    const TriangleMesh mesh = two_slivers(height, height);
    const Sums found = sums_of(mesh, 0, 1, 1e-6);
    INFO("height " << height << ", " << found.points << " points");
    CHECK(found.areas == Approx(0.25 * height * height).epsilon(1e-12));
    CHECK(sums_of(mesh, 1, 0, 1e-6).potential == Approx(found.potential).epsilon(1e-12));
    if (points == 0) CHECK(found.potential == Approx(exact.potential).epsilon(1e-5));
    // cells of half the length, times four if slivers became similar slivers: eight times the pairs
    if (points > 0) CHECK(found.points < 4.5 * points);
    points = found.points;
  }
}

TEST_CASE("triangles with midpoints that are left out are close, and get all that is left out") {
  const auto is_close = [](const PairQuadrature& q) {
    return q.is_close(0, 1, KernelPart::static_part) && q.is_close(0, 1, KernelPart::dynamic_part);
  };
  int left_out = 0;
  for (double height : {1.0, 0.3, 0.02})
    for (double distance : {0.01, 0.1, 0.2, 0.24, 0.3, 1.0, 5.0})
      for (double tolerance : {1e-8, 1e-6, 1e-4, 1e-2}) {
        INFO("height " << height << ", distance " << distance << ", tolerance " << tolerance);
        const TriangleMesh mesh = two_slivers(height, distance);
        const PairQuadrature quadrature(mesh, tolerance, 0);
        double weights = 0, rest = 0;
        quadrature.for_each_midpoint(0, 1, [&](const PairPoint& p) { weights += p.weight; });
        quadrature.for_each_point(0, 1, KernelPart::static_part, PairShare::beyond_midpoints,
                                  [&](const PairPoint& p) { rest += p.weight; });
        const double areas = quadrature.area(0) * quadrature.area(1);
        CHECK(rest == Approx((1 - weights) * areas).margin(1e-12 * areas));
        if (weights > 1 - 1e-9) continue;
        ++left_out;
        CHECK(is_close(quadrature));
      }
  CHECK(left_out > 20);
}
