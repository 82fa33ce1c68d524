#pragma once

#include "collision/collision_detector.hpp"
#include "collision/penetration.hpp"
#include "mesh/shapes.hpp"
#include "support/moved_points.hpp"

#include <map>
#include <vector>

#include <catch2/catch.hpp>

namespace bem::test {

/// Surfaces with their start and end positions, and planes.
struct ContactScene {
  std::vector<CollisionSurface> surfaces;
  std::vector<std::vector<Vec3>> start, end;
  std::vector<CollisionPlane> planes;
  CollisionOptions options;

  /// A body that moves by `step` during the step; returns its index.
  int add(const TriangleMesh& mesh, const Vec3& position, const Vec3& step = Vec3::Zero(),
          bool prescribed = false) {
    surfaces.push_back({mesh.triangles, static_cast<int>(mesh.vertices.size()), prescribed, false});
    start.push_back(moved(mesh.vertices, position));
    end.push_back(moved(start.back(), step));
    return static_cast<int>(surfaces.size()) - 1;
  }

  std::vector<SurfaceMotion> motions() const {
    std::vector<SurfaceMotion> result;
    for (std::size_t i = 0; i < start.size(); ++i) result.push_back({&start[i], &end[i]});
    return result;
  }

  CollisionDetector detector() const { return {surfaces, planes, options}; }
  std::vector<Contact> detect() const { return detector().detect(motions()); }

  /// Place of a point at the start (t = 0) or end (t = 1); a plane's is the contact's point.
  Vec3 place(const SurfacePoint& p, const Contact& c, int t) const {
    return p.count == 0 ? c.point : p.place((t == 0 ? start : end)[p.surface]);
  }
};

/// What every contact has to fulfil; returns the contacts.
inline std::vector<Contact> checked(const ContactScene& scene,
                                    const std::vector<Contact>& contacts) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& c = contacts[i];
    if (i > 0) CHECK(contacts[i - 1].key < c.key);
    CHECK(c.normal.norm() == Approx(1).epsilon(1e-12));
    for (const SurfacePoint* p : {&c.a, &c.b}) {
      double sum = p->count == 0 ? 1 : 0;
      for (int k = 0; k < p->count; ++k) {
        CHECK(p->weights[k] >= 0);
        sum += p->weights[k];
      }
      CHECK(sum == Approx(1).epsilon(1e-12));
    }
    const Vec3 offset = scene.place(c.a, c, 1) - scene.place(c.b, c, 1);
    CHECK((scene.place(c.b, c, 1) - c.point).norm() < 1e-12);
    CHECK((scene.place(c.a, c, 0) - scene.place(c.b, c, 0) - c.offset_start).norm() < 1e-12);
    CHECK(std::abs(c.normal.dot(offset) - c.gap_end) < 1e-12);
    CHECK(std::abs(c.normal.dot(c.offset_start) - c.gap_start) < 1e-12);
    CHECK(c.gap_end < scene.options.margin);
  }
  return contacts;
}

inline std::vector<Contact> checked(const ContactScene& scene) {
  return checked(scene, scene.detect());
}

inline int count(const std::vector<Contact>& contacts, ContactKind kind) {
  int n = 0;
  for (const Contact& c : contacts) n += c.key.kind == kind;
  return n;
}

/// Largest deviation of any normal from `direction`, in which the lower surface pushes the body.
inline double tilt(const std::vector<Contact>& contacts, const Vec3& direction, int body = 1) {
  double largest = 0;
  for (const Contact& c : contacts)
    largest = std::max(largest, (c.normal - (c.a.surface == body ? 1 : -1) * direction).norm());
  return largest;
}

/// A square of two triangles facing +z, corners (+-half, +-half, 0).
inline TriangleMesh two_triangle_floor(double half) {
  return {{{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}},
          {{0, 1, 2}, {0, 2, 3}}};
}

}  // namespace bem::test
