#include "base/parallel.hpp"
#include "collision_test.hpp"

#include <algorithm>
#include <ctime>
#include <set>

using namespace bem;
using namespace bem::test;

namespace {

/// Are both lists the same to the last bit?
bool identical(const std::vector<Contact>& x, const std::vector<Contact>& y) {
  return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](const Contact& c, const Contact& d) {
    return c.key == d.key && c.normal == d.normal && c.point == d.point &&
           c.offset_start == d.offset_start && c.gap_start == d.gap_start &&
           c.gap_end == d.gap_end && c.a.weights == d.a.weights && c.b.weights == d.b.weights &&
           c.a.vertices == d.a.vertices && c.b.vertices == d.b.vertices;
  });
}

/// Spheres packed in a bowl, each turned differently.
ContactScene spheres_in_bowl(int subdivisions, int layers) {
  ContactScene scene;
  scene.add(bowl(0.6, 0.05, 80), Vec3::Zero(), Vec3::Zero(), true);
  const TriangleMesh sphere = icosphere(subdivisions, 0.08);
  for (int n = 0; n < 9 * layers; ++n) {
    const Vec3 at(0.16 * (n % 3 - 1), 0.16 * (n / 3 % 3 - 1), -0.35 + 0.16 * (n / 9));
    scene.add({moved(sphere.vertices, Vec3::Zero(), turned({1, 0.3 * n, 2}, n)), sphere.triangles},
              at, {0, 0, -3e-4});
  }
  return scene;
}

const Vec3 kUp = Vec3::UnitZ();
const Vec3 kFall(0, 0, -4e-5);

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
    CAPTURE(i, depth);
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

TEST_CASE("a sphere in a bowl rests on vertices of both") {
  ContactScene scene;
  scene.add(bowl(0.5, 0.05, 64), Vec3::Zero(), Vec3::Zero(), true);
  const double radius = 0.1;
  // The sphere is moved down on the bowl's inner surface of radius 0.45 by 2 mm.
  scene.add(icosphere(3, radius), {0.02, 0.01, -0.45 + radius + 1e-3}, {0, 0, -2e-3});
  const auto contacts = checked(scene);
  REQUIRE_FALSE(contacts.empty());
  double violation = 0;
  for (const Contact& c : contacts) {
    violation = std::min(violation, c.gap_end);
    const Vec3 inward = -c.point.normalized();
    CHECK((c.a.surface == 1 ? 1 : -1) * c.normal.dot(inward) > 0.97);
    CHECK(c.key.kind == ContactKind::vertex_triangle);  // inside, the bowl has no convex edge
  }
  CHECK(violation < -3e-4);
  CHECK(violation > -2.5e-3);
}

TEST_CASE("contacts are the same for any number of threads and in every call") {
  const int threads = thread_count();
  ContactScene scene = spheres_in_bowl(3, 2);
  CollisionDetector detector = scene.detector();
  set_thread_count(1);
  const auto one = detector.detect(scene.motions());
  set_thread_count(4);
  const auto four = detector.detect(scene.motions());
  set_thread_count(threads);
  CHECK(one.size() > 20);
  CHECK(identical(one, four));
  CHECK(identical(one, scene.detect()));
  // The tree built elsewhere gives the same contacts after a refit.
  ContactScene before = scene;
  for (std::size_t i = 1; i < before.start.size(); ++i)
    before.start[i] = before.end[i] = moved(before.start[i], {0.1, 0.2, 0.3}, turned(kUp, 1));
  CollisionDetector refitted = before.detector();
  refitted.detect(before.motions());
  CHECK(identical(one, refitted.detect(scene.motions())));
}

TEST_CASE("what a detector has seen before does not change its contacts") {
  ContactScene scene;
  scene.planes.push_back({Vec3::Zero(), kUp});
  scene.add(box({0.3, 0.3, 0.1}, {1, 1, 1}), {1, 0, -0.05});
  const TriangleMesh cube = box({0.1, 0.1, 0.1}, {2, 2, 2});
  for (double x : {0.0, 1.0}) scene.add(cube, {x, 0, 0.05}, Vec3::Zero());
  const auto rest = scene.start;
  CollisionDetector detector = scene.detector();
  std::size_t most = 0;
  for (double gap : {1.2e-3, 0.9e-3, 1.05e-3, 0.6e-3, 0.95e-3, 1.3e-3, 0.99e-3, 1e-5}) {
    for (std::size_t s = 1; s < rest.size(); ++s)
      scene.start[s] = scene.end[s] = moved(rest[s], {0, 0, gap});
    const auto found = detector.detect(scene.motions());
    CHECK(identical(found, scene.detect()));
    most = std::max(most, found.size());
  }
  CHECK(most >= 13);
}

TEST_CASE("a pair keeps its key while it stays together") {
  ContactScene scene;
  scene.add(box({0.3, 0.3, 0.1}, {1, 1, 1}), {0, 0, -0.05});
  scene.add(box({0.1, 0.1, 0.1}, {2, 2, 2}), {0.02, 0.05, 0.05}, kFall);
  CollisionDetector detector = scene.detector();
  const auto first = detector.detect(scene.motions());
  // Corrected ends, then the next step from there.
  scene.end[1] = moved(scene.start[1], Vec3(1e-5, 0, 1e-9));
  const auto corrected = detector.detect(scene.motions());
  scene.start = scene.end;
  scene.end[1] = moved(scene.start[1], kFall);
  const auto next = detector.detect(scene.motions());
  REQUIRE(first.size() == 9);
  REQUIRE(corrected.size() == first.size());
  REQUIRE(next.size() == first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(corrected[i].key == first[i].key);
    CHECK(next[i].key == first[i].key);
  }
}

TEST_CASE("obstacles, ignored pairs and distant surfaces have no contacts") {
  ContactScene scene;
  const TriangleMesh cube = box({1, 1, 1}, {1, 1, 1});
  scene.add(cube, {0, 0, 0.5});
  scene.add(cube, {0, 0, -0.5});
  scene.planes.push_back({{0, 0, -1}, kUp});
  CHECK(scene.detect().size() == 8);
  scene.options.ignored_pairs = {{1, 0}};
  CHECK(scene.detect().size() == 4);
  scene.options.ignored_pairs = {{1, 0}, {1, 2}};
  CHECK(scene.detect().empty());
  scene.options.ignored_pairs.clear();
  scene.surfaces[1].prescribed = true;
  CHECK(scene.detect().size() == 4);
  scene.surfaces[0].prescribed = true;
  CHECK(scene.detect().empty());
  scene.surfaces[0].prescribed = false;
  scene.start[0] = scene.end[0] = moved(scene.start[0], {0, 0, 0.01});
  CHECK(scene.detect().empty());
}

TEST_CASE("a folded strip touches itself, an unfolded surface does not") {
  // A strip along x, bent up and over so that its two halves face each other 1 mm apart.
  ContactScene scene;
  const TriangleMesh strip = box({0.4, 0.05, 0.004}, {60, 6, 1});
  scene.add(strip, Vec3::Zero());
  scene.surfaces[0].self_contact = true;
  scene.options.margin = scene.options.recovery_depth = 1.5e-3;
  CHECK(scene.detect().empty());
  const double radius = 0.0025;  // of the inner side of the bend
  for (Vec3& p : scene.start[0]) {
    const double bend = kPi * (radius + 0.002), s = p[0], height = 0.002 - p[2];
    if (s < 0) continue;
    if (s < bend) {
      const double angle = s / (radius + 0.002), r = radius + height;
      p = Vec3(r * std::sin(angle), p[1], 0.002 + radius - r * std::cos(angle));
    } else {
      p = Vec3(bend - s, p[1], 0.002 + 2 * radius + height);
    }
  }
  // The upper half comes down by 4.5 mm; the halves are 5 mm apart.
  scene.end = scene.start;
  for (Vec3& p : scene.end[0])
    if (p[2] > 0.0065 && p[0] < 0) p[2] -= 4.5e-3;
  const auto near = checked(scene);
  REQUIRE(near.size() > 20);
  for (const Contact& c : near) {
    CHECK(std::abs(c.normal[2]) > 0.9);
    CHECK(c.gap_end > 0);
  }
  for (Vec3& p : scene.end[0])
    if (p[2] > 1.8e-3 && p[0] < 0 && p[2] != 0.002) p[2] -= 1e-3;
  double violation = 0;
  for (const Contact& c : checked(scene)) violation = std::min(violation, c.gap_end);
  CHECK(violation < -4e-4);
  scene.surfaces[0].self_contact = false;
  CHECK(scene.detect().empty());
}

TEST_CASE("closed shapes at rest do not touch themselves") {
  for (const TriangleMesh& mesh :
       {torus(0.1, 0.03, 40, 16), bowl(0.1, 0.01, 40), bowl(0.1, 8e-4, 60), star(3, 0.1),
        notched_cube(0.1, 8), bumpy_cube(0.1, 8, 0.1)}) {
    ContactScene scene;
    scene.add(mesh, Vec3::Zero(), kFall);
    scene.surfaces[0].self_contact = true;
    CHECK(scene.detect().empty());
  }
}

TEST_CASE("time of one call for 25 spheres of 2562 vertices in a bowl", "[.timing]") {
  ContactScene scene = spheres_in_bowl(4, 3);
  CollisionDetector detector = scene.detector();
  const auto motions = scene.motions();
  detector.detect(motions);
  const std::clock_t begin = std::clock();
  const int calls = 20;
  std::size_t contacts = 0;
  for (int i = 0; i < calls; ++i) contacts = detector.detect(motions).size();
  WARN("27 spheres: " << 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / calls
                      << " ms of CPU time per call, " << contacts << " contacts");
  CHECK(contacts > 100);
}
