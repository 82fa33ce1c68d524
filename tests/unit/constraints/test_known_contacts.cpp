#include "constraints/known_contacts.hpp"

#include <catch2/catch.hpp>

using namespace bem;

namespace {

/// Vertex 7 of surface 0 against a triangle of surface 1.
ContactPair seen(int triangle, const Vec3& normal, double gap, const Vec3& point = Vec3::Zero()) {
  ContactPair pair;
  pair.contact.key = {0, 1, ContactKind::vertex_triangle, 7, triangle};
  pair.contact.normal = normal.normalized();
  pair.contact.point = point;
  pair.contact.gap_end = gap;
  pair.friction = 0.5;
  return pair;
}

const ContactTolerances kTolerances(1e-6, 1);

KnownContacts::Manner usual(bool all_views, bool friction = true) {
  return {-1e-6, -1e-6, all_views, friction};
}

}  // namespace

TEST_CASE("a contact that is seen otherwise replaces what was known, until all views count") {
  const Vec3 left(-1, 0, 3), right(1, 0, 3);
  KnownContacts known(kTolerances);
  known.take({seen(3, left, -1e-3)}, usual(false));
  known.take({seen(3, right, -1e-3)}, usual(false));
  REQUIRE(known.pairs().size() == 1);
  CHECK(known.pairs()[0].contact.normal == right.normalized());

  // not broken as seen now: it stays
  known.take({seen(3, left, 1e-5)}, usual(true));
  REQUIRE(known.pairs().size() == 1);
  CHECK(known.pairs()[0].contact.normal == right.normalized());

  known.take({seen(3, left, -1e-3)}, usual(true));
  REQUIRE(known.pairs().size() == 2);
  CHECK(known.pairs()[0].contact.key.view == 0);
  CHECK(known.pairs()[0].contact.normal == left.normalized());
  CHECK(known.pairs()[1].contact.key.view == 1);
  CHECK(known.pairs()[1].contact.normal == right.normalized());
}

TEST_CASE("a contact has at most three older views") {
  KnownContacts known(kTolerances);
  for (int i = 0; i < 9; ++i) known.take({seen(3, Vec3(i, 0, 5), -1e-3)}, usual(true));
  REQUIRE(known.pairs().size() == 4);
  CHECK(known.pairs()[0].contact.normal == Vec3(8, 0, 5).normalized());
}

TEST_CASE("what goes over a ridge takes its older views off the triangle that it leaves") {
  KnownContacts known(kTolerances);
  known.take({seen(3, Vec3(-1, 0, 3), -1e-3)}, usual(true));
  known.take({seen(3, Vec3(-2, 0, 3), -1e-3)}, usual(true));
  CHECK(known.pairs().size() == 2);
  known.take({seen(4, Vec3(1, 0, 3), -1e-3, Vec3(1, 0, -1))}, usual(true));
  REQUIRE(known.pairs().size() == 1);
  CHECK(known.pairs()[0].contact.key.feature_b == 4);
}

TEST_CASE("friction can be left out and come back") {
  KnownContacts known(kTolerances);
  known.take({seen(3, Vec3(0, 0, 1), -1e-3)}, usual(false, false));
  CHECK(known.pairs()[0].friction == 0);
  known.restore_friction();
  REQUIRE(known.pairs().size() == 1);
  CHECK(known.pairs()[0].friction == 0.5);
}
