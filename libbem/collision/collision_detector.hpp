#pragma once

#include "base/types.hpp"
#include "collision/contact.hpp"

#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace bem {

/// A triangle mesh that can be touched on its outer side, the one its normals point to. Closed or
/// open; every edge has one or two triangles of consistent orientation. A sheet that holds on both
/// sides is one surface with two layers (mesh/two_sided.hpp) some distance apart.
struct CollisionSurface {
  std::vector<Triangle> triangles;
  int vertex_count = 0;
  bool prescribed = false;    ///< an obstacle: no contact with planes and other such surfaces
  bool self_contact = false;  ///< contact of the surface with itself too
  /// Penetration at the start of a step that is pushed out of this surface at most [m]; of a sheet
  /// with two layers the distance between them.
  double recovery_depth = std::numeric_limits<double>::infinity();
};

/// The half space below a plane that does not move.
struct CollisionPlane {
  Vec3 point = Vec3::Zero();    ///< [m]
  Vec3 normal = Vec3::UnitZ();  ///< unit vector out of the half space
};

struct CollisionOptions : ContactLimits {
  /// Pairs of surfaces without contact, by index (planes follow the surfaces).
  std::vector<std::pair<int, int>> ignored_pairs;
};

/// Where the vertices of a surface are at the start and, as predicted, at the end of a step [m].
struct SurfaceMotion {
  const std::vector<Vec3>* start = nullptr;
  const std::vector<Vec3>* end = nullptr;
};

/// Finds the contacts of a step among surfaces and with planes: pairs of features (vertex and
/// triangle, edge and edge, vertex and plane) that touch at the start, hit each other on the way
/// (vertices move on straight lines), or end within the margin. The method is in docs/method.md,
/// "Collision detection". Contacts are sorted by key and bit-identical for any number of threads;
/// what is remembered of earlier calls makes a call faster, but does not change its result.
class CollisionDetector {
 public:
  /// Throws ErrorCode::internal for meshes that are not as CollisionSurface says.
  CollisionDetector(std::vector<CollisionSurface> surfaces, std::vector<CollisionPlane> planes,
                    CollisionOptions options);
  ~CollisionDetector();
  CollisionDetector(CollisionDetector&&) noexcept;
  CollisionDetector& operator=(CollisionDetector&&) noexcept;

  /// One motion per surface. When the forces of these contacts have changed the ends, call again:
  /// a pair that is found again keeps its key and has its points and normal where they now are, one
  /// that is not keeps its inequality. The ends are free of penetration when no contact of such a
  /// call has gap_end < 0. O(n) for the boxes plus O(log n) per close pair.
  /// `pressed`: keys, ascending, of contacts that held in the step before and whose sides are in
  /// each other by more than the recovery depth, up to `deepest` [m]; they are found all the same.
  std::vector<Contact> detect(const std::vector<SurfaceMotion>& motions,
                              const std::vector<ContactKey>& pressed = {}, double deepest = 0);
  /// Vertices of a triangle and of an edge of a surface.
  const Triangle& triangle(int surface, int triangle) const;
  const std::array<int, 2>& edge(int surface, int edge) const;
  /// May the surfaces (planes follow them) touch each other, or is their pair ignored?
  bool is_allowed(int a, int b) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bem
