#include "mesh/open_edges.hpp"
#include "mesh/shapes.hpp"
#include "mesh/surface.hpp"
#include "mesh_test.hpp"

using namespace bem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const TriangleMesh kBox = box({1, 1, 1}, {4, 4, 4});

bool is_top(const Triangle& t) {
  return triangle_centroid(kBox, t)[2] > 0.49;
}

/// The box with a lid that does not share the vertices of its rim but lies `gap` beside it.
TriangleMesh with_loose_lid(double gap) {
  TriangleMesh mesh = kBox;
  const int offset = static_cast<int>(mesh.vertices.size());
  for (const Vec3& v : kBox.vertices) mesh.vertices.push_back(v + Vec3(gap, 0, 0));
  for (std::size_t i = 0; i < kBox.triangles.size(); ++i)
    if (is_top(kBox.triangles[i]))
      for (int& v : mesh.triangles[i]) v += offset;
  return mesh;
}

std::string open_refusal(const TriangleMesh& mesh) {
  return test::error_message(ErrorCode::invalid_input, [&] { make_surface(mesh, "a.obj"); });
}

}  // namespace

TEST_CASE("edges that lie on each other are found with the distance that joins them") {
  const OpenEdges open = find_open_edges(with_loose_lid(1e-9));
  CHECK(open.edges.size() == 32);
  CHECK(open.matched == 32);
  CHECK(open.tolerance == Approx(1e-9).epsilon(1e-6));
  CHECK(open.remaining == 0);
  for (std::size_t i = 0; i < open.edges.size(); ++i) CHECK(open.twin[i] != open.edges[i]);
  CHECK(find_open_edges(with_loose_lid(0.01)).matched == 0);
}

TEST_CASE("the message about loose edges names both, the distance, and what remains open") {
  TriangleMesh mesh = with_loose_lid(1e-9);
  CHECK_THAT(open_refusal(mesh),
             StartsWith("a.obj: edges that lie on each other without sharing") &&
                 Contains("32 such edges in all") && Contains("up to 1.01e-09 m") &&
                 Contains("that closes the surface"));
  mesh.triangles.erase(mesh.triangles.begin());
  CHECK_THAT(open_refusal(mesh), Contains("that leaves 3 open edges"));
}

TEST_CASE("a hole is called a hole, and a vertex on an edge is shown") {
  TriangleMesh mesh = kBox;
  mesh.triangles.pop_back();
  CHECK_THAT(open_refusal(mesh), StartsWith("a.obj: open boundary: ") && Contains("3 such edges") &&
                                     Contains("close the holes"));
  // a tetrahedron whose face 1 2 3 is two triangles around the middle of edge 1-2
  mesh = test::unit_tetrahedron();
  mesh.vertices.push_back({0.5, 0.5, 0});
  mesh.triangles.back() = {4, 2, 3};
  mesh.triangles.push_back({1, 4, 3});
  CHECK_THAT(open_refusal(mesh), Contains("the vertex at (0.5, 0.5, 0) lies on it") &&
                                     Contains("3 such edges") && Contains("split the edges"));
}
