#include "broken_meshes.hpp"
#include "mesh/mass_properties.hpp"
#include "repair/mend.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem::test;

namespace {

double volume_of(const Mended& mended) {
  REQUIRE(mended.acceptance.accepted());
  return mass_properties(outward(mended.acceptance), 1).volume;
}

bool told(const Mended& mended, const std::string& words) {
  return std::any_of(mended.steps.begin(), mended.steps.end(), [&](const std::string& step) {
    return step.find(words) != std::string::npos;
  });
}

}  // namespace

TEST_CASE("small holes are filled, large ones are left") {
  const TriangleMesh ball = icosphere(2, 0.3);
  const Mended mended = mend(without(ball, 0, 8), {}, 2);
  CHECK(told(mended, "filled 1 hole"));
  CHECK(volume_of(mended) == Approx(volume_of(mend(ball, {}, 1))).epsilon(0.03));

  const TriangleMesh half = without(ball, 0, 160);
  const Mended left = mend(half, {}, 1);
  CHECK(left.sheet);
  CHECK(!left.holes.empty());
  RepairOptions all;
  all.fill_all_holes = true;
  CHECK(volume_of(mend(half, all, 1)) > 0);
}

TEST_CASE("cubes that share a face become one solid") {
  TriangleMesh along_face = both(cube(), cube(), {1, 0, 0});
  CHECK(volume_of(mend(along_face, {}, 1)) == Approx(2));
}

TEST_CASE("repeated triangles and triangles without area go") {
  TriangleMesh mesh = cube();
  mesh.triangles.push_back({0, 0, 0});
  const Triangle t = mesh.triangles[0];
  mesh.triangles.push_back({t[1], t[0], t[2]});
  CHECK(volume_of(mend(mesh, {}, 1)) == Approx(1));
}

TEST_CASE("triangles that cross are replaced where that changes little") {
  TriangleMesh ball = icosphere(3, 0.3);
  const Triangle t = ball.triangles[100];
  Vec3& tip = ball.vertices[t[0]];
  for (double pull = 1; check_acceptance(ball).crossings == 0 && pull < 2; pull += 0.1)
    tip = ball.vertices[t[1]] + pull * (ball.vertices[t[2]] - tip);
  REQUIRE(check_acceptance(ball).crossings > 0);
  const Mended mended = mend(ball, {}, 1);
  CHECK(told(mended, "that crossed each other"));
  CHECK(volume_of(mended) == Approx(0.1125).epsilon(0.02));
}

TEST_CASE("loose parts are dropped, cavities are kept") {
  const TriangleMesh ball = icosphere(2, 0.3);
  const TriangleMesh dusty = both(without(both(ball, icosphere(0, 0.002), {0.5, 0, 0}), 0, 1),
                                  icosphere(1, 0.1), {0, 0, 0});
  const Mended mended = mend(dusty, {}, 1);
  CHECK(told(mended, "dropped 1 loose part"));
  CHECK(volume_of(mended) < 0.99 * volume_of(mend(ball, {}, 1)));
}
