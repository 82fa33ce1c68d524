#pragma once

#include "base/state_archive.hpp"

#include <array>
#include <tuple>

namespace bem {

/// A material point of a surface, sum_i weights[i] x(vertices[i]) over `count` vertices, with
/// weights >= 0 that sum to one. A point of a plane has no vertices.
struct SurfacePoint {
  int surface = -1;  ///< index; planes follow the surfaces
  int count = 0;
  std::array<int, 3> vertices = {-1, -1, -1};
  std::array<double, 3> weights = {0, 0, 0};

  /// Place of the point when its surface's vertices are at `positions`; the origin for a plane.
  template <typename Positions>
  Vec3 place(const Positions& positions) const {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < count; ++i) sum += weights[i] * positions[vertices[i]];
    return sum;
  }
};

// What the searches for vertex and for edge contacts have in common.
inline constexpr double kSameSide = 0.5;  ///< cosine above which two normals hold on one side
inline constexpr double kTurned = 0.9;    ///< cosine above which the normal at the end is taken
inline constexpr double kRim = 0.1;       ///< width of the rim of a feature, of the margin

enum class ContactKind {
  vertex_plane,
  vertex_triangle,  ///< the vertex is side a, the triangle side b
  edge_edge
};

/// Names a contact by what touches; the same pair has the same key in every call and step.
struct ContactKey {
  int surface_a = -1;
  int surface_b = -1;
  ContactKind kind = ContactKind::vertex_plane;
  int feature_a = -1;  ///< vertex or edge
  int feature_b = -1;  ///< triangle or edge; 0 for a plane
  int view = 0;        ///< 0: as seen last; others: as seen before in the same step

  void visit_state(StateArchive& state) {
    state(surface_a, surface_b, kind, feature_a, feature_b, view);
  }
  auto tuple() const { return std::tie(surface_a, surface_b, kind, feature_a, feature_b, view); }
  bool operator<(const ContactKey& other) const { return tuple() < other.tuple(); }
  bool operator==(const ContactKey& other) const { return tuple() == other.tuple(); }
  bool operator!=(const ContactKey& other) const { return !(*this == other); }
};

/// Lengths that decide what is a contact [m].
struct ContactLimits {
  /// Pairs that end the step closer than this are contacts, too, though nothing penetrates yet;
  /// keep it below half the thickness of the thinnest part.
  double margin = 1e-3;
  /// Penetration at the start of a step that counts as touching.
  double tolerance = 1e-6;
  /// Penetration at the start of a step that is still pushed out the shortest way; what is deeper
  /// is left alone. Keep it below half the thickness of the thinnest part.
  double recovery_depth = 1e-3;
};

/// Two material points that must not pass each other during a step: with end-of-step positions x
///
///     g(x) = normal . (a(x) - b(x)) >= 0,
///
/// and the slip over the step is the tangential part of a(x) - b(x) - offset_start. A plane does
/// not move: its b is `point`.
struct Contact {
  SurfacePoint a, b;
  Vec3 normal = Vec3::Zero();        ///< unit vector from side b to side a
  Vec3 point = Vec3::Zero();         ///< b at the predicted end of the step [m]
  Vec3 offset_start = Vec3::Zero();  ///< a - b at the start of the step [m]
  double gap_start = 0;              ///< normal . offset_start [m]
  double gap_end = 0;                ///< g at the predicted end [m]
  ContactKey key;
  /// A vertex that has entered backwards, through a triangle that no side of it faces, and ends
  /// inside. Such motions are predicted where other contacts are still missing, and mean something
  /// only when these are met.
  bool backward = false;
};

}  // namespace bem
