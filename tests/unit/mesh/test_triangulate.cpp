#include "mesh/triangulate.hpp"
#include "mesh_test.hpp"

#include <algorithm>
#include <ctime>

using namespace bem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

using Face = std::vector<int>;

PolygonMesh polygons(const std::vector<Vec3>& vertices, const std::vector<Face>& faces) {
  PolygonMesh mesh;
  mesh.vertices = vertices;
  for (const Face& face : faces) {
    mesh.corners.insert(mesh.corners.end(), face.begin(), face.end());
    mesh.end_face();
  }
  return mesh;
}

std::vector<Triangle> triangles_of(const std::vector<Vec3>& vertices,
                                   const std::vector<Face>& faces) {
  return triangulate(polygons(vertices, faces), "a.obj").triangles;
}

/// One face with all vertices in their order.
TriangleMesh cut(const std::vector<Vec3>& corners) {
  Face all;
  for (std::size_t k = 0; k < corners.size(); ++k) all.push_back(static_cast<int>(k));
  return triangulate(polygons(corners, {all}), "a.obj");
}

/// Sums of the triangles' areas, seen from +z and without regard to their side; equal where the
/// triangles cover a face of the plane without leaving it.
std::pair<double, double> areas(const TriangleMesh& mesh) {
  double seen = 0, all = 0;
  for (const Triangle& t : mesh.triangles) {
    seen += area_vector(mesh, t).z();
    all += triangle_area(mesh, t);
  }
  return {seen, all};
}

double worst_height(const TriangleMesh& mesh) {
  double worst = 1;
  for (const Triangle& t : mesh.triangles) worst = std::min(worst, height_ratio(mesh, t));
  return worst;
}

void check_cover(const std::vector<Vec3>& corners, double area) {
  const TriangleMesh mesh = cut(corners);
  CHECK(mesh.triangles.size() == corners.size() - 2);
  CHECK(areas(mesh).first == Approx(area).epsilon(1e-12));
  CHECK(areas(mesh).second == Approx(area).epsilon(1e-12));
  CHECK(worst_height(mesh) > 1e-4);
}

std::vector<Vec3> moved(std::vector<Vec3> points, bool to_float) {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (Vec3& p : points) {
    p = turn * p + Vec3(0.3, 0.1, 0.7);
    if (to_float) p = p.cast<float>().cast<double>();
  }
  return points;
}

const std::vector<Vec3> kL{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
const std::vector<Vec3> kU{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0},
                           {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
/// Square of width 3 with a square hole of width 1, the line from corner 3 to it both ways.
const std::vector<Vec3> kKeyhole{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {1, 2, 0},
                                 {2, 2, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 3, 0}};
/// Square with straight corners in the middle of each side.
const std::vector<Vec3> kStraight{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                  {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};

}  // namespace

TEST_CASE("concave faces are covered without leaving them, whichever corner comes first") {
  for (std::size_t first = 0; first < kU.size(); ++first) {
    std::vector<Vec3> l = kL, u = kU, straight = kStraight,
                      arrow{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}};
    std::rotate(l.begin(), l.begin() + first % l.size(), l.end());
    std::rotate(u.begin(), u.begin() + first, u.end());
    std::rotate(straight.begin(), straight.begin() + first, straight.end());
    std::rotate(arrow.begin(), arrow.begin() + first % 4, arrow.end());
    check_cover(l, 3);
    check_cover(u, 7);
    check_cover(straight, 4);
    check_cover(arrow, 1);
  }
}

TEST_CASE("holes that bridges connect to the rim stay holes") {
  check_cover(kKeyhole, 8);
  // the same with its own vertices instead of repeated positions
  const std::vector<Vec3> eight(kKeyhole.begin(), kKeyhole.begin() + 8);
  const TriangleMesh mesh = triangulate(polygons(eight, {{0, 1, 2, 3, 4, 5, 6, 7, 4, 3}}), "a.obj");
  CHECK(mesh.triangles.size() == 8);
  CHECK(areas(mesh).second == Approx(8));
}

TEST_CASE("rounding to single precision does not change the triangles") {
  for (const auto& face : {kL, kU, kKeyhole, kStraight}) {
    const auto exact = cut(face).triangles;
    CHECK(cut(moved(face, false)).triangles == exact);
    CHECK(cut(moved(face, true)).triangles == exact);
  }
}

TEST_CASE("convex faces without straight corners stay fans around their first corner") {
  CHECK(cut({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}).triangles ==
        std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(cut({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.3}, {0, 1, 0}}).triangles ==
        std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(cut({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}}).triangles ==
        std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
}

TEST_CASE("a quad is not cut into a triangle without area") {
  CHECK(cut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 2, 0}}).triangles ==
        std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}});
  CHECK(cut({{1, 0, 0}, {2, 0, 0}, {1, 2, 0}, {0, 0, 0}}).triangles ==
        std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("corners that repeat the one before are left out, other triangles stay as they are") {
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 1, 0}};
  CHECK(triangles_of(corners, {{0, 1, 2, 2}}) == std::vector<Triangle>{{0, 1, 2}});
  CHECK(triangles_of(corners, {{0, 1, 2, 4, 3, 0}}) == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(triangles_of(corners, {{0, 1, 1}, {0, 1, 2, 3}}) ==
        std::vector<Triangle>{{0, 1, 1}, {0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("diagonals that are edges elsewhere are exchanged") {
  // two quads around a vertex that only they have (1), and the two triangles that close the body
  const std::vector<Vec3> v{{0, 0, 0}, {1, -0.2, 1}, {2, 0, 0}, {1, 1, 0}, {1, -1, 0}};
  const std::vector<Face> doublet{{0, 1, 2, 3}, {2, 1, 0, 4}, {0, 3, 2}, {0, 2, 4}};
  for (int first = 0; first < 4; ++first) {
    std::vector<Face> faces = doublet;
    std::rotate(faces[0].begin(), faces[0].begin() + first, faces[0].end());
    std::rotate(faces[1].begin(), faces[1].begin() + first, faces[1].end());
    std::vector<std::pair<int, int>> edges;
    for (const Triangle& t : triangles_of(v, faces))
      for (int k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
    std::sort(edges.begin(), edges.end());
    CHECK(std::adjacent_find(edges.begin(), edges.end()) == edges.end());
  }
}

TEST_CASE("two faces with one rim get diagonals of their own") {
  std::vector<Vec3> ring;
  Face front, back;
  for (int k = 0; k < 7; ++k) {
    ring.emplace_back(std::cos(k), std::sin(k), 0.1 * (k % 2));
    front.push_back(k);
    back.push_back((7 - k) % 7);
  }
  std::vector<std::pair<int, int>> edges;
  for (const Triangle& t : triangles_of(ring, {front, back}))
    for (int k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
  CHECK(edges.size() == 30);
  std::sort(edges.begin(), edges.end());
  CHECK(std::adjacent_find(edges.begin(), edges.end()) == edges.end());
}

TEST_CASE("faces that cross or touch themselves are refused by name") {
  const auto refusal = [](const std::vector<Vec3>& corners) {
    return test::error_message(ErrorCode::invalid_input, [&] { cut(corners); });
  };
  std::vector<Vec3> star, twice;
  for (int k = 0; k < 5; ++k)
    star.emplace_back(std::cos(0.8 * kPi * k), std::sin(0.8 * kPi * k), 0);
  twice.emplace_back(0, 0, 0);  // every triangle of the fan around it looks the right way
  for (int k = 0; k < 8; ++k)
    twice.emplace_back((1 + 0.1 * k) * std::cos(kPi * k / 3), (1 + 0.1 * k) * std::sin(kPi * k / 3),
                       0);
  CHECK_THAT(refusal(star), StartsWith("a.obj: face 0 with 5 corners from vertex 0 at (1, 0, 0)") &&
                                Contains("crosses"));
  CHECK_THAT(refusal(twice), Contains("crosses"));
  CHECK_THAT(refusal({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}), Contains("crosses"));
  CHECK_THAT(refusal({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1, 0}}), Contains("crosses"));
  PolygonMesh with_lines = polygons(star, {{0, 1, 2, 3, 4}});
  with_lines.lines = {17};
  CHECK_THAT(
      test::error_message(ErrorCode::invalid_input, [&] { triangulate(with_lines, "a.obj"); }),
      StartsWith("a.obj:17: face 0"));
}

TEST_CASE("what cannot be cut becomes a fan that the checks of a mesh name") {
  const std::vector<Vec3> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1.5, 0, 0}};
  CHECK(cut(line).triangles.size() == 3);
  CHECK(triangles_of(kL, {{0, 1, 9, 3}}) == std::vector<Triangle>{{0, 1, 9}, {0, 9, 3}});
  std::vector<Vec3> bad = kL;
  bad[2][1] = std::nan("");
  CHECK(cut(bad).triangles.size() == 4);
}

TEST_CASE("a comb of 10,000 corners takes a moment") {
  std::vector<Vec3> comb;
  const int teeth = 2500;
  for (int k = 0; k < teeth; ++k) {
    comb.emplace_back(2 * k, 1, 0);
    comb.emplace_back(2 * k, 0.1, 0);
    comb.emplace_back(2 * k + 1, 0.1, 0);
    comb.emplace_back(2 * k + 1, 1, 0);
  }
  comb.emplace_back(2 * teeth, 0, 0);
  comb.emplace_back(-1, 0, 0);
  std::reverse(comb.begin(), comb.end());
  const std::clock_t start = std::clock();
  const TriangleMesh mesh = cut(comb);
  CHECK(double(std::clock() - start) / CLOCKS_PER_SEC < 5);
  CHECK(mesh.triangles.size() == comb.size() - 2);
  CHECK(areas(mesh).first == Approx(areas(mesh).second).epsilon(1e-12));
}
