#include "base/parallel.hpp"
#include "contact_test.hpp"

#include <chrono>
#include <cstring>
#include <random>
#include <set>
#include <sstream>

using namespace bem;
using namespace bem::test;

namespace {

const Vec3 kUp = Vec3::UnitZ();
const Vec3 kFall(0, 0, -4e-5);

std::string listed(const std::vector<Contact>& contacts) {
  std::ostringstream text;
  for (const Contact& c : contacts)
    text << c.key.surface_a << " " << c.key.surface_b << " kind " << (int)c.key.kind << " "
         << c.key.feature_a << " " << c.key.feature_b << " n " << c.normal.transpose() << " gap "
         << c.gap_start << " " << c.gap_end << " at " << c.point.transpose() << "\n";
  return text.str();
}
}  // namespace

TEST_CASE("nothing declared, nothing found") {
  ContactScene scene;
  CHECK(scene.detect().empty());
  scene.add(icosphere(1, 0.1), Vec3::Zero());
  CHECK(scene.detect().empty());
}

TEST_CASE("a cube on a plane touches with its bottom vertices") {
  ContactScene scene;
  const TriangleMesh cube = box({0.1, 0.1, 0.1}, {3, 3, 3});
  scene.planes.push_back({Vec3::Zero(), kUp});
  scene.add(cube, {0, 0, 0.05}, kFall + Vec3(1e-3, 0, 0));
  const auto contacts = checked(scene);
  int bottom = 0;
  for (const Vec3& v : cube.vertices) bottom += v[2] < -0.0499;
  CHECK(bottom == 16);
  CHECK(static_cast<int>(contacts.size()) == bottom);
  for (const Contact& c : contacts) {
    CHECK(c.key.kind == ContactKind::vertex_plane);
    CHECK(c.key.surface_b == 1);
    CHECK(c.gap_end == Approx(-4e-5));
    CHECK(std::abs(c.gap_start) < 1e-15);
  }
}

TEST_CASE("a cube on a bigger cube touches with its corners only") {
  ContactScene scene;
  const int big = scene.add(box({0.3, 0.3, 0.1}, {1, 1, 1}), {0, 0, -0.05});
  const double gap = GENERATE(0.0, 5e-7, -1e-6, 2e-4);
  CAPTURE(gap);
  const Mat3 turn = turned(kUp, 0.3);
  const TriangleMesh cube = box({0.1, 0.1, 0.1}, {1, 1, 1});
  scene.add({moved(cube.vertices, Vec3::Zero(), turn), cube.triangles}, {0.02, 0.03, 0.05 + gap},
            kFall);
  auto contacts = checked(scene);
  CHECK(tilt(contacts, kUp) < 1e-12);
  std::set<int> vertices;
  for (const Contact& c : contacts) {
    CHECK(c.key.kind == ContactKind::vertex_triangle);
    CHECK(c.b.surface == big);
    vertices.insert(c.key.feature_a);
  }
  CHECK(vertices == std::set<int>{0, 1, 2, 3});
  CHECK(contacts.size() == 4);
}

TEST_CASE("cubes stacked flush touch once per pair of vertices") {
  ContactScene scene;
  const TriangleMesh cube = box({0.1, 0.1, 0.1}, {2, 2, 2});
  scene.add(cube, {0, 0, -0.05});
  scene.add(cube, {0, 0, 0.05}, kFall);
  const auto contacts = checked(scene);
  CHECK(contacts.size() == 9);
  CHECK(tilt(contacts, kUp) < 1e-12);
}

TEST_CASE("crossed beams touch where their edges cross") {
  ContactScene scene;
  const double gap = GENERATE(0.0, -1e-6, 1e-5);
  scene.add(box({0.1, 1, 0.1}, {1, 1, 1}), {0, 0, -0.05});
  scene.add(box({1, 0.1, 0.1}, {1, 1, 1}), {0.01, 0.02, 0.05 + gap}, kFall);
  const auto contacts = checked(scene);
  CHECK(contacts.size() == 4);
  CHECK(count(contacts, ContactKind::edge_edge) == 4);
  CHECK(tilt(contacts, kUp) < 1e-12);
}

TEST_CASE("an overhanging cube is held by corners and crossing edges") {
  ContactScene scene;
  scene.add(box({0.1, 0.2, 0.1}, {1, 1, 1}), {0, 0, -0.05});
  scene.add(box({0.1, 0.1, 0.1}, {1, 1, 1}), {0.05, 0.01, 0.05}, kFall);
  const auto contacts = checked(scene);
  CHECK(contacts.size() == 4);  // two corners of the upper cube and two crossings
  CHECK(count(contacts, ContactKind::edge_edge) == 2);
  CHECK(tilt(contacts, kUp) < 1e-12);
}

TEST_CASE("a box sliding over a triangulated floor touches vertically all the way") {
  const int divisions = GENERATE(1, 2);
  const bool closed = GENERATE(false, true);
  const double depth = GENERATE(0.0, 1e-7, -1e-6);
  const TriangleMesh cube = box({0.1, 0.1, 0.1}, {divisions, divisions, divisions});
  const TriangleMesh slab = box({2, 2, 0.2}, {4, 4, 1});
  for (int i = 0; i < 200; ++i) {
    const double x = -0.5 + 5e-3 * i;
    ContactScene scene;
    if (closed)
      scene.add(slab, {0, 0, -0.1}, Vec3::Zero(), true);
    else
      scene.add(two_triangle_floor(1), Vec3::Zero(), Vec3::Zero(), true);
    scene.add(cube, {x, 0.3 * x, 0.05 + depth}, {5e-3, 1.5e-3, -4e-5});
    const auto contacts = scene.detect();
    REQUIRE(tilt(contacts, kUp) < 1e-12);
    // A floor vertex may come to lie under the cube, nothing else may be in contact.
    const int bottom = divisions == 1 ? 4 : 9;
    REQUIRE(static_cast<int>(contacts.size()) >= bottom);
    REQUIRE(static_cast<int>(contacts.size()) <= bottom + 1);
    REQUIRE(count(contacts, ContactKind::edge_edge) == 0);
  }
}

TEST_CASE("a box that slides from one block to a flush one does not catch") {
  const double depth = GENERATE(0.0, 1e-7, -1e-6);
  for (int i = 0; i < 100; ++i) {
    ContactScene scene;
    const TriangleMesh block = box({0.5, 0.5, 0.1}, {2, 2, 1});
    scene.add(block, {-0.25, 0, -0.05}, Vec3::Zero(), true);
    scene.add(block, {0.25, 0, -0.05}, Vec3::Zero(), true);
    scene.add(box({0.1, 0.1, 0.1}, {1, 1, 1}), {-0.1 + 2e-3 * i, 0.012, 0.05 + depth},
              {2e-3, 0, -4e-5});
    const auto contacts = scene.detect();
    CAPTURE(i, depth, listed(contacts));
    REQUIRE(contacts.size() >= 4);
    REQUIRE(tilt(contacts, kUp, 2) < 1e-12);
  }
}

TEST_CASE("a body at 20 m/s does not pass a plate of 5 mm in 3 ms") {
  ContactScene scene;
  scene.add(box({0.5, 0.5, 0.005}, {4, 4, 1}), {0, 0, -0.0025}, Vec3::Zero(), true);
  const bool cube = GENERATE(true, false);
  const double height = GENERATE(0.001, 0.02, 0.055);
  scene.add(cube ? box({0.02, 0.02, 0.02}, {1, 1, 1}) : icosphere(2, 0.01),
            {0.013, 0.017, 0.01 + height}, {0.005, -0.003, -0.06});
  const auto contacts = checked(scene);
  CAPTURE(cube, height);
  REQUIRE(tilt(contacts, kUp) < 1e-12);
  // Moved along the normals by the largest violation, the body is where it was stopped.
  double violation = 0;
  for (const Contact& c : contacts) violation = std::min(violation, c.gap_end);
  CHECK(violation == Approx(height - 0.06).epsilon(1e-9));
}

TEST_CASE("dump") {
  ContactScene scene;
  scene.add(box({0.1, 0.1, 0.1}, {1, 1, 1}), {0, 0, 0.05}, kFall);
  scene.add(box({0.1, 0.1, 0.1}, {1, 1, 1}), {0, 0, -0.05});
  for (const Contact& c : scene.detect())
    WARN(c.key.surface_a << " " << c.key.surface_b << " kind " << (int)c.key.kind << " "
                         << c.key.feature_a << " " << c.key.feature_b << " n "
                         << c.normal.transpose() << " gap " << c.gap_end << " at "
                         << c.point.transpose());
  CHECK(true);
}
