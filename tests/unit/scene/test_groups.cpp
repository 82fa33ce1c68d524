#include "mesh/shapes.hpp"
#include "mesh/surface.hpp"
#include "scene/groups.hpp"
#include "scene/selection.hpp"
#include "scene_examples.hpp"

#include <set>

#include <catch2/catch.hpp>

using bem::Vec3;
using bem::test::scene_with_body;

namespace {

bem::Selection selection(const std::string& json) {
  return bem::parse_scene("s.json", scene_with_body(",\"fixed\": [" + json + "]"))
      .bodies[0]
      .fixed[0];
}

const bem::BodyGeometry& ball() {
  static const bem::BodyGeometry geometry =
      bem::make_geometry(bem::make_surface(bem::icosphere(2, 1), "ball"), 1000);
  return geometry;
}

/// The nodes of the ball that `inside` holds for.
template <class Inside>
std::vector<int> nodes_where(const Inside& inside) {
  std::set<int> nodes;
  for (std::size_t v = 0; v < ball().input.vertices.size(); ++v)
    if (inside(ball().input.vertices[v])) nodes.insert(ball().node_of_vertex[v]);
  return {nodes.begin(), nodes.end()};
}

std::string group_error(const std::string& members) {
  return bem::test::scene_error(scene_with_body(members));
}

}  // namespace

TEST_CASE("a sphere and the side of a plane choose what lies in them") {
  const auto in_sphere =
      nodes_where([](const Vec3& x) { return (x - Vec3(0, 1, 0)).norm() <= 0.7; });
  CHECK(in_sphere.size() > 5);
  CHECK(in_sphere.size() < ball().nodes.vertices.size() / 2);
  CHECK(bem::select_nodes(ball(),
                          selection(R"({"sphere": {"center": [0, 1, 0], "radius": "70 cm"}})")) ==
        in_sphere);
  const auto on_side = nodes_where([](const Vec3& x) { return x[2] >= 0.5; });
  CHECK(on_side.size() > 5);
  CHECK(bem::select_nodes(ball(),
                          selection(R"({"plane": {"point": [7, 7, 0.5], "normal": [0, 0, 3]}})")) ==
        on_side);
  const auto up = bem::select_triangles(
      ball(),
      selection(
          R"({"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}, "normal": [0, 0, 1], "normal_tolerance_deg": 20})"));
  CHECK(!up.empty());
  for (int t : up)
    CHECK(bem::triangle_normal(ball().nodes, ball().nodes.triangles[t])[2] >=
          std::cos(20 * bem::kPi / 180));
}

TEST_CASE("groups of a body are selections by name") {
  const bem::BodySpec body =
      bem::parse_scene("s.json", scene_with_body(R"(,"fixed": [{"group": "tip"}],
    "handles": [{"select": {"group": "tip"}}], "tractions": [{"select": {"group": "end"}, "pressure": 1}],
    "groups": {"tip": {"sphere": {"center": [1, 2, 3], "radius": 4}}, "end": {"triangles": [7]}})"))
          .bodies[0];
  CHECK(body.fixed[0].kind == bem::Selection::Kind::sphere);
  CHECK(body.fixed[0].point == Vec3(1, 2, 3));
  CHECK(body.handles[0].select.radius == 4);
  CHECK(body.tractions[0].select.indices == std::vector<int>{7});
}

TEST_CASE("unknown groups are told of with those that there are") {
  const std::string hint =
      "; those of a mesh file are not in an archive: write them to the body's \"groups\")";
  CHECK(group_error(R"(,"fixed": [{"group": "tpi"}], "groups": {"tip": "all", "base": "all"})") ==
        "s.json:4:12: /bodies/0/fixed/0: there is no group \"tpi\"; did you mean \"tip\"? "
        "(groups here: \"base\", \"tip\"" +
            hint);
  CHECK(group_error(R"(,"fixed": [{"group": "tpi"}])") ==
        "s.json:4:12: /bodies/0/fixed/0: there is no group \"tpi\" (groups here: none" + hint);
  CHECK(group_error(R"(,"groups": {"a": {"group": "b"}, "b": "all"})") ==
        "s.json:4:18: /bodies/0/groups/a: a group cannot consist of another one");
  CHECK(group_error(R"(,"groups": [1])") ==
        "s.json:4:12: /bodies/0/groups: expected the groups of a body (an object), found an array "
        "of length 1");
}

TEST_CASE("groups of a mesh are triangles, and a group of the scene hides one of its name") {
  bem::Groups groups(bem::NamedRanges{{"wing", {{4, 6}, {5, 8}}}, {"tail", {{0, 2}}}});
  bem::Selection all;
  groups.add("tail", all);
  bem::Selection wing, tail;
  wing.kind = tail.kind = bem::Selection::Kind::group;
  wing.group = "wing";
  tail.group = "tail";
  groups.resolve(wing);
  groups.resolve(tail);
  CHECK(wing.kind == bem::Selection::Kind::triangles);
  CHECK(wing.indices == std::vector<int>{4, 5, 6, 7});
  CHECK(tail.kind == bem::Selection::Kind::all);
}
