#include "collision/moving_surface.hpp"
#include "collision_test.hpp"

using namespace bem;
using namespace bem::test;

namespace {

struct Fixture {
  explicit Fixture(TriangleMesh m, const Vec3& step = Vec3::Zero())
      : mesh(std::move(m)),
        end(moved(mesh.vertices, step)),
        topology(make_topology(mesh.triangles, static_cast<int>(mesh.vertices.size()))),
        surface{0, &topology, &mesh.vertices, &end} {}

  int edge(int v, int w) const {
    for (std::size_t e = 0; e < topology.edges.size(); ++e) {
      const auto& ends = topology.edges[e].vertices;
      if ((ends[0] == v && ends[1] == w) || (ends[0] == w && ends[1] == v))
        return static_cast<int>(e);
    }
    return -1;
  }

  TriangleMesh mesh;
  std::vector<Vec3> end;
  SurfaceTopology topology;
  MovingSurface surface;
};

/// A roof over the x axis: ridge from (0,0,0) to (1,0,0), eaves at y = -1 and 1, z = `eaves`.
TriangleMesh roof(double eaves) {
  return {{{0, 0, 0}, {1, 0, 0}, {0.5, 1, eaves}, {0.5, -1, eaves}}, {{0, 1, 2}, {1, 0, 3}}};
}

}  // namespace

TEST_CASE("positions in between and pseudonormals") {
  const Fixture cube(box({2, 2, 2}, {1, 1, 1}), {0, 0, 4});
  const Vec3 corner = cube.mesh.vertices[0];
  CHECK((cube.surface.vertex(0, 0.25) - corner - Vec3(0, 0, 1)).norm() < 1e-15);
  // Weighting by angles makes the diagonal of a face irrelevant.
  for (int v = 0; v < 8; ++v)
    CHECK((vertex_normal(cube.surface, v, 1) - cube.mesh.vertices[v].normalized()).norm() < 1e-14);
}

TEST_CASE("arcs of normals at ridges, flat edges and valleys") {
  const Vec3 up = Vec3::UnitZ();
  const Fixture ridge(roof(-1)), flat(roof(0)), valley(roof(1));
  const NormalArc arc = normal_arc(ridge.surface, ridge.edge(0, 1), 0);
  CHECK(arc.angle == Approx(kPi / 2));
  CHECK(arc.contains(up));
  CHECK(arc.contains(Vec3(0, 1, 1).normalized()));
  CHECK_FALSE(arc.contains(Vec3::UnitY()));
  CHECK_FALSE(arc.contains(-up));
  CHECK(std::abs(normal_arc(flat.surface, flat.edge(0, 1), 0).angle) < 1e-15);
  CHECK(normal_arc(valley.surface, valley.edge(0, 1), 0).angle == Approx(-kPi / 2));
  // At the boundary: from the normal to the direction along the sheet.
  const NormalArc rim = normal_arc(flat.surface, flat.edge(1, 2), 0);
  CHECK(rim.angle == Approx(kPi / 2));
  CHECK(rim.contains(up));
  CHECK(rim.contains(Vec3(2, 1, 0).normalized()));
  CHECK_FALSE(rim.contains(Vec3(-2, -1, 0).normalized()));
}

TEST_CASE("which way a vertex may be pushed") {
  const Fixture slab(box({2, 2, 2}, {2, 2, 2}));
  int top = -1, corner = -1, rim = -1;
  for (std::size_t v = 0; v < slab.mesh.vertices.size(); ++v) {
    const Vec3& p = slab.mesh.vertices[v];
    if (p == Vec3(0, 0, 1)) top = static_cast<int>(v);
    if (p == Vec3(1, 1, 1)) corner = static_cast<int>(v);
    if (p == Vec3(1, 0, 1)) rim = static_cast<int>(v);
  }
  REQUIRE((top >= 0 && corner >= 0 && rim >= 0));
  const auto pushed = [&](int v, const Vec3& n) {
    return faces(slab.surface, v, 0, n.normalized());
  };
  CHECK(pushed(top, {0, 0, -1}));
  CHECK(pushed(top, {0.5, 0, -1}));
  CHECK_FALSE(pushed(top, {1, 0, 0}));
  CHECK_FALSE(pushed(top, {0, 0, 1}));
  CHECK(pushed(corner, {-1, 0, 0}));
  CHECK_FALSE(pushed(corner, {1, 0, 0}));
  CHECK(pushed(rim, {-1, 0, 0}));
  CHECK_FALSE(pushed(rim, {0, 1, 0}));
  CHECK(is_tip(slab.surface, corner, 0, -Vec3::UnitX()));
  CHECK_FALSE(is_tip(slab.surface, top, 0, -Vec3::UnitX()));
  CHECK_FALSE(is_tip(slab.surface, top, 0, Vec3(0.5, 0, -1).normalized()));
}

TEST_CASE("height and overhang of a point over a triangle") {
  const Fixture flat(roof(0));
  const TrianglePlace inside = place_at_triangle({0.5, 0.25, -0.3}, flat.surface, 0, 0);
  CHECK(inside.height == Approx(-0.3));
  CHECK(inside.overhang < 1e-15);
  const TrianglePlace outside = place_at_triangle({0.5, -0.25, 0.3}, flat.surface, 0, 0);
  CHECK(outside.height == Approx(0.3));
  CHECK(outside.overhang == Approx(0.25));
}
