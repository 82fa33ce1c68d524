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
  quadrature.for_each_point(tx, ty, KernelPart::static_part, [&](const PairPoint& p) {
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
