#include "mesh/triangulate.hpp"

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "mesh/describe.hpp"
#include "mesh/face_triangles.hpp"
#include "mesh/weld.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace bem {
namespace {

using EdgeKey = std::uint64_t;

EdgeKey key_of(int a, int b) {
  return static_cast<EdgeKey>(std::min(a, b)) << 32 | static_cast<EdgeKey>(std::max(a, b));
}

bool has_only_triangles(const PolygonMesh& mesh) {
  return mesh.corners.size() == 3 * mesh.face_count();
}

bool can_be_measured(const PolygonMesh& mesh) {
  const int n = static_cast<int>(mesh.vertices.size());
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                     [](const Vec3& v) { return v.allFinite(); }) &&
         std::all_of(mesh.corners.begin(), mesh.corners.end(),
                     [n](int v) { return v >= 0 && v < n; });
}

void append_fan(const int* face, std::size_t corners, std::vector<Triangle>& triangles) {
  for (std::size_t k = 2; k < corners; ++k) triangles.push_back({face[0], face[k - 1], face[k]});
}

class Triangulation {
 public:
  Triangulation(PolygonMesh mesh, const std::string& source, CrossingFaces crossing)
      : mesh_(std::move(mesh)), source_(source), crossing_(crossing) {
    std::vector<int> all(mesh_.vertices.size());
    std::iota(all.begin(), all.end(), 0);
    position_ = first_at_position(mesh_.vertices, std::move(all));
  }

  TriangleMesh run(std::vector<std::size_t>* first_triangles) {
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      check_interruption();
      first_triangle_.push_back(triangles_.size());
      append_face(f);
    }
    first_triangle_.push_back(triangles_.size());
    separate_edges();
    if (first_triangles) *first_triangles = std::move(first_triangle_);
    return {std::move(mesh_.vertices), std::move(triangles_)};
  }

 private:
  /// Vertices of a face without those that repeat the position of the one before.
  std::vector<int> distinct_corners(std::size_t f) const {
    std::vector<int> corners;
    for (std::size_t k = 0; k < mesh_.corner_count(f); ++k) {
      const int v = mesh_.face(f)[k];
      if (corners.empty() || position_[v] != position_[corners.back()]) corners.push_back(v);
    }
    while (corners.size() > 1 && position_[corners.front()] == position_[corners.back()])
      corners.pop_back();
    return corners;
  }

  FaceTriangles cut(const std::vector<int>& corners) const {
    std::vector<Vec3> points;
    std::vector<int> place;
    std::unordered_map<int, int> first;
    for (int v : corners) {
      points.push_back(mesh_.vertices[v]);
      place.push_back(first.emplace(position_[v], static_cast<int>(place.size())).first->second);
    }
    return {std::move(points), std::move(place)};
  }

  void append_face(std::size_t f) {
    const std::vector<int> corners = distinct_corners(f);
    if (mesh_.corner_count(f) == 3 || corners.size() < 3)
      return append_fan(mesh_.face(f), mesh_.corner_count(f), triangles_);
    if (corners.size() == 3) return append_fan(corners.data(), 3, triangles_);
    const FaceTriangles face = cut(corners);
    if (face.crosses_itself() && crossing_ == CrossingFaces::fan)
      return append_fan(corners.data(), corners.size(), triangles_);
    if (face.crosses_itself()) refuse(f, corners);
    for (const Triangle& t : face.triangles())
      triangles_.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
  }

  [[noreturn]] void refuse(std::size_t f, const std::vector<int>& corners) const {
    const std::string line = mesh_.lines.empty() ? "" : ":" + std::to_string(mesh_.lines[f]);
    throw Error(ErrorCode::invalid_input,
                source_ + line + ": face " + std::to_string(f) + " with " +
                    std::to_string(corners.size()) + " corners from " +
                    vertex_text({mesh_.vertices, {}}, corners[0]) +
                    " (counting from 0) crosses or touches itself, seen along its normal: cut it "
                    "into triangles in the program that it comes from");
  }

  EdgeKey key(int a, int b) const { return key_of(position_[a], position_[b]); }

  /// No edge belongs to more than two triangles in a surface of which something can be computed.
  /// Where one does because faces were cut along it, each of them gets another diagonal if it can,
  /// so that the order of the faces does not matter.
  void separate_edges() {
    for (const Triangle& t : triangles_)
      for (int k = 0; k < 3; ++k) ++uses_[key(t[k], t[(k + 1) % 3])];
    for (const auto& [edge, uses] : uses_)
      if (uses > 2) crowded_.insert(edge);
    if (crowded_.empty()) return;
    for (std::size_t f = 0; f < mesh_.face_count(); ++f)
      if (mesh_.corner_count(f) > 3 && has_crowded_edge(f)) separate_edges_of(f);
  }

  bool has_crowded_edge(std::size_t f) const {
    for (std::size_t t = first_triangle_[f]; t < first_triangle_[f + 1]; ++t)
      for (int k = 0; k < 3; ++k)
        if (crowded_.count(key(triangles_[t][k], triangles_[t][(k + 1) % 3])) > 0) return true;
    return false;
  }

  void separate_edges_of(std::size_t f) {
    const std::vector<int> corners = distinct_corners(f);
    if (corners.size() < 4) return;
    FaceTriangles face = cut(corners);
    const auto edge_of = [&](const FaceTriangles::Diagonal& d) {
      return key(corners[d.first], corners[d.second]);
    };
    bool flipped = false;
    for (bool again = true; again;) {
      again = false;
      for (const FaceTriangles::Diagonal& d : face.diagonals()) {
        if (crowded_.count(edge_of(d)) == 0) continue;
        const auto other = face.other_diagonal(d);
        if (!other || uses_[edge_of(*other)] > 0) continue;
        uses_[edge_of(d)] -= 2;
        uses_[edge_of(*other)] += 2;
        face.flip(d);
        flipped = again = true;
      }
    }
    if (flipped) replace(f, face, corners);
  }

  void replace(std::size_t f, FaceTriangles& face, const std::vector<int>& corners) {
    face.sort();
    std::size_t at = first_triangle_[f];
    for (const Triangle& t : face.triangles())
      triangles_[at++] = {corners[t[0]], corners[t[1]], corners[t[2]]};
  }

  PolygonMesh mesh_;
  const std::string& source_;
  CrossingFaces crossing_;
  std::vector<int> position_;  ///< of each vertex, the first one that is where it is
  std::vector<Triangle> triangles_;
  std::vector<std::size_t> first_triangle_;  ///< of each face, and the number of all
  std::unordered_map<EdgeKey, int> uses_;    ///< how many triangles have each edge
  std::unordered_set<EdgeKey> crowded_;      ///< edges that more than two had at first
};

}  // namespace

TriangleMesh triangulate(PolygonMesh polygons, const std::string& source, CrossingFaces crossing,
                         std::vector<std::size_t>* first_triangles) {
  if (!has_only_triangles(polygons) && can_be_measured(polygons))
    return Triangulation(std::move(polygons), source, crossing).run(first_triangles);
  TriangleMesh mesh;
  std::vector<std::size_t> first = {0};
  for (std::size_t f = 0; f < polygons.face_count(); ++f) {
    append_fan(polygons.face(f), polygons.corner_count(f), mesh.triangles);
    first.push_back(mesh.triangles.size());
  }
  if (first_triangles) *first_triangles = std::move(first);
  mesh.vertices = std::move(polygons.vertices);
  return mesh;
}

}  // namespace bem
