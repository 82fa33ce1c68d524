#include "collision/vertex_contacts.hpp"
#include "collision_test.hpp"

#include <set>

using namespace bem;
using namespace bem::test;

namespace {

/// A needle: a small tetrahedron whose vertex 0 is the origin, opening towards (1, 1, 1).
TriangleMesh needle() {
  const std::vector<Vec3> along_z = {
      {0, 0, 0}, {0.01, 0, 0.03}, {-0.005, 0.009, 0.03}, {-0.005, -0.009, 0.03}};
  return {moved(along_z, Vec3::Zero(), turned({-1, 1, 0}, std::acos(std::sqrt(1.0 / 3)))),
          {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}};
}

/// Contacts of the needle's tip with a prescribed surface.
std::vector<Contact> tip_contacts(const TriangleMesh& surface, const Vec3& from, const Vec3& to) {
  ContactScene scene;
  scene.add(surface, Vec3::Zero(), Vec3::Zero(), true);
  scene.add(needle(), from, to - from);
  std::vector<Contact> contacts;
  for (const Contact& c : checked(scene))
    if (c.key.kind == ContactKind::vertex_triangle && c.a.surface == 1 && c.key.feature_a == 0)
      contacts.push_back(c);
  return contacts;
}

const TriangleMesh kSlab = box({1, 1, 0.1}, {4, 4, 1});  // top at z = 0.05

}  // namespace

TEST_CASE("a vertex that falls is held by the triangle under it") {
  const auto hit = tip_contacts(kSlab, {0.1, 0.13, 0.07}, {0.13, 0.1, 0.03});
  REQUIRE(hit.size() == 1);
  CHECK((hit[0].normal - Vec3::UnitZ()).norm() < 1e-12);
  CHECK((hit[0].point - Vec3(0.13, 0.1, 0.05)).norm() < 1e-12);
  CHECK(hit[0].gap_end == Approx(-0.02));
  CHECK(hit[0].gap_start == Approx(0.02));
  // Near: within the margin of 1 mm, with nothing to push yet; beyond it nothing.
  CHECK(tip_contacts(kSlab, {0.1, 0.13, 0.07}, {0.1, 0.13, 0.0509}).size() == 1);
  CHECK(tip_contacts(kSlab, {0.1, 0.13, 0.07}, {0.1, 0.13, 0.0511}).empty());
  // It leaves, or comes from below.
  CHECK(tip_contacts(kSlab, {0.1, 0.13, 0.05}, {0.1, 0.13, 0.07}).empty());
}

TEST_CASE("a vertex that enters backwards and ends inside is held by what is nearest") {
  // The needle opens upwards, so that no side of it faces the underside of the slab.
  const auto contacts = tip_contacts(kSlab, {0.1, 0.13, -0.07}, {0.13, 0.1, -0.03});
  REQUIRE(contacts.size() == 1);
  CHECK((contacts[0].normal + Vec3::UnitZ()).norm() < 1e-12);
  CHECK((contacts[0].point - Vec3(0.13, 0.1, -0.05)).norm() < 1e-12);
  CHECK(contacts[0].gap_end == Approx(-0.02));
  CHECK(contacts[0].backward);
  // It has left again.
  CHECK(tip_contacts(kSlab, {0.1, 0.13, -0.07}, {0.1, 0.13, 0.07}).empty());
}

TEST_CASE("a vertex deeper than the recovery depth is left alone, others are pushed out") {
  CHECK(tip_contacts(kSlab, {0.1, 0.13, 0.048}, {0.1, 0.13, 0.048}).empty());
  for (const double depth : {1e-7, 1e-6, 1e-5, 9e-4}) {
    const auto contacts =
        tip_contacts(kSlab, {0.1, 0.13, 0.05 - depth}, {0.1, 0.13, 0.05 - depth - 4e-5});
    REQUIRE(contacts.size() == 1);
    CHECK((contacts[0].normal - Vec3::UnitZ()).norm() < 1e-12);
    CHECK(contacts[0].gap_end == Approx(-depth - 4e-5).epsilon(1e-9));
  }
}

TEST_CASE("a vertex that slides off an edge is held while it is above") {
  // Beyond the edge before it comes down to the top: nothing holds it.
  CHECK(tip_contacts(kSlab, {0.49, 0.1, 0.0505}, {0.52, 0.1, 0.0497}).empty());
  // Through the top first.
  const auto contacts = tip_contacts(kSlab, {0.49, 0.1, 0.0505}, {0.51, 0.1, 0.0475});
  REQUIRE(contacts.size() == 1);
  CHECK((contacts[0].normal - Vec3::UnitZ()).norm() < 1e-12);
}

TEST_CASE("walls of a corner hold together, sides of a ridge one at a time") {
  const TriangleMesh corner = notched_cube(0.4, 4);  // open for x, y, z > 0
  // Through the floor first, then behind the walls: the floor holds.
  const auto floor = tip_contacts(corner, {5e-4, 6e-4, 7e-4}, {-1e-4, -2e-4, -3e-4});
  REQUIRE(floor.size() == 1);
  CHECK((floor[0].normal - Vec3::UnitZ()).norm() < 1e-12);
  // On the floor, the walls near.
  const auto walls = tip_contacts(corner, {5e-4, 6e-4, 0}, {2e-4, 3e-4, 0});
  REQUIRE(walls.size() == 3);
  std::set<int> axes;
  for (const Contact& c : walls) {
    Eigen::Index axis = 0;
    CHECK(c.normal.maxCoeff(&axis) == Approx(1));
    axes.insert(static_cast<int>(axis));
  }
  CHECK(axes.size() == 3);
  // A ridge of a cube: the tip goes in across the edge x = z = 0.05.
  const auto ridge =
      tip_contacts(box({0.1, 0.1, 0.1}, {1, 1, 1}), {0.05, 0.01, 0.05}, {0.049, 0.01, 0.0496});
  REQUIRE(ridge.size() == 1);
  CHECK((ridge[0].normal - Vec3::UnitZ()).norm() < 1e-12);
}

TEST_CASE("the second call finds the wall behind the floor") {
  const TriangleMesh corner = notched_cube(0.4, 4);
  // Into the floor first, then under the wall: the floor holds.
  const auto first = tip_contacts(corner, {2e-3, 0.05, 1e-3}, {-3e-3, 0.05, -4e-3});
  REQUIRE(first.size() == 1);
  CHECK((first[0].normal - Vec3::UnitZ()).norm() < 1e-12);
  const auto second = tip_contacts(corner, {2e-3, 0.05, 1e-3}, {-3e-3, 0.05, 0});
  bool wall = false;
  for (const Contact& c : second) wall = wall || (c.normal - Vec3::UnitX()).norm() < 1e-12;
  CHECK(wall);
}

TEST_CASE("a vertex that sits on an edge inside a flat face has one contact") {
  for (const Vec3& at : {Vec3(0.125, 0.125, 0.05), Vec3(0.25, 0.25, 0.05), Vec3(0.25, 0.1, 0.05)}) {
    const auto contacts = tip_contacts(kSlab, at, at + Vec3(1e-3, 0, -4e-5));
    REQUIRE(contacts.size() == 1);
    CHECK((contacts[0].normal - Vec3::UnitZ()).norm() < 1e-12);
  }
}
