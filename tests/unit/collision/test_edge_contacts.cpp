#include "collision/edge_contacts.hpp"
#include "collision_test.hpp"

#include <algorithm>
#include <cmath>

using namespace bem;
using namespace bem::test;

namespace {

/// A roof with a ridge along x at z = 0, closed below.
TriangleMesh ridge() {
  return {
      {{-1, 0, 0}, {1, 0, 0}, {1, 0.5, -0.5}, {1, -0.5, -0.5}, {-1, 0.5, -0.5}, {-1, -0.5, -0.5}},
      {{0, 1, 2}, {0, 2, 4}, {1, 0, 5}, {1, 5, 3}, {1, 3, 2}, {0, 4, 5}, {4, 2, 3}, {4, 3, 5}}};
}

std::vector<Contact> crossed(const Vec3& from, const Vec3& to, double angle = 1.1) {
  ContactScene scene;
  scene.add(ridge(), Vec3::Zero());
  TriangleMesh upper = ridge();
  upper.vertices = moved(upper.vertices, Vec3::Zero(),
                         turned(Vec3::UnitZ(), angle) * turned(Vec3::UnitX(), kPi));
  scene.add(upper, from, to - from);
  return checked(scene);
}

}  // namespace

TEST_CASE("two ridges that cross have one contact") {
  for (const double height : {0.3, 1e-3, 1e-6, 0.0, -1e-6, -5e-4}) {
    const auto contacts = crossed({0.1, 0.05, height}, {0.12, 0.03, height - 0.01});
    REQUIRE(contacts.size() == (height < 0.1 ? 1 : 0));
    if (contacts.empty()) continue;
    CHECK(contacts[0].key.kind == ContactKind::edge_edge);
    CHECK((contacts[0].normal + Vec3::UnitZ()).norm() < 1e-12);  // side a is the lower one
    CHECK(contacts[0].gap_end == Approx(height - 0.01));
    CHECK(std::abs(contacts[0].point[2] - height + 0.01) < 1e-12);
  }
}

TEST_CASE("ridges that end within the margin are in contact, too") {
  CHECK(crossed({0, 0, 0.1}, {0, 0, 9e-4}).size() == 1);
  CHECK(crossed({0, 0, 0.1}, {0, 0, 1.1e-3}).empty());
  CHECK(crossed({0, 0, 0}, {0, 0, 2e-3}).empty());  // they part
}

TEST_CASE("a fast ridge does not pass the other one") {
  const auto contacts = crossed({0, 0, 0.01}, {0.05, 0.02, -0.2});
  REQUIRE(contacts.size() >= 1);
  double gap = 0;
  for (const Contact& c : contacts) {
    CHECK((c.normal + Vec3::UnitZ()).norm() < 1e-12);
    gap = std::min(gap, c.gap_end);
  }
  CHECK(gap == Approx(-0.2));
}

TEST_CASE("an edge that comes over another one end first is held") {
  // Its end vertex starts on the other ridge, and the ridge ends 3 mm deep in it.
  const Vec3 along(std::cos(1.1), std::sin(1.1), 0);
  const Vec3 from = along - Vec3(0, 0, 1e-7);
  double gap = 0;
  for (const Contact& c : crossed(from, from - 0.02 * along - Vec3(0, 0, 3e-3)))
    if (c.key.kind == ContactKind::edge_edge) gap = std::min(gap, c.gap_end);
  CHECK(gap == Approx(-3e-3 - 1e-7));
}

TEST_CASE("concave and flat edges have no contacts") {
  // A ridge lowered into the valley of an open surface, and on a flat one.
  const TriangleMesh upper{moved(ridge().vertices, {0, 0, 0}, turned(Vec3::UnitX(), kPi)),
                           ridge().triangles};
  for (const double eaves : {0.5, 0.0}) {
    ContactScene scene;
    scene.add({{{0, -2, 0}, {0, 2, 0}, {-2, 0, eaves}, {2, 0, eaves}}, {{0, 1, 2}, {1, 0, 3}}},
              Vec3::Zero(), Vec3::Zero(), true);
    scene.add(upper, {0.01, 0.3, 1e-4}, {0, 0, -2e-4});
    CHECK(count(checked(scene), ContactKind::edge_edge) == 0);
  }
}
