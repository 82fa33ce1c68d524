#pragma once

#include "handover/animated_scene.hpp"

#include <cstdint>
#include <vector>

namespace bem {

/// The faces of a body as triangles with the vertices that graphics cards want: one for every
/// vertex, texture coordinate and side of a crease, which is an edge whose triangles enclose more
/// than 50 degrees. Vertices without a face are left out.
class ShadedSurface {
 public:
  /// `points`: positions of the body's vertices that decide on creases and diagonals, [N x 3].
  /// O(n log n).
  ShadedSurface(const AnimatedBody& body, const std::vector<double>& points);

  std::size_t size() const { return vertices_.size(); }  ///< number of its vertices
  const std::vector<std::uint32_t>& corners() const { return corners_; }  ///< [triangles x 3]
  bool has_uvs() const { return !body_.corner_uvs.empty(); }
  /// [size x 2], v downwards as glTF has it; 0, 0 for vertices without.
  std::vector<float> uvs() const;
  /// Of positions of the body's vertices [N x 3] those of its own, [size x 3].
  std::vector<double> at_vertices(const std::vector<double>& points) const;
  /// Unit normals, [size x 3].
  std::vector<double> normals(const std::vector<double>& points) const;

 private:
  struct Vertex {
    std::uint32_t group;  ///< of the triangles around one side of a vertex
    int uv;
  };

  void cut_faces(const std::vector<double>& points);
  void find_groups(const std::vector<double>& points);
  void number_vertices();
  std::vector<Vec3> triangle_normals(const std::vector<double>& points) const;

  const AnimatedBody& body_;
  std::vector<Triangle> triangles_;          ///< vertices of the body
  std::vector<int> corner_uvs_;              ///< by corner of the triangles
  std::vector<std::uint32_t> corner_group_;  ///< likewise
  std::vector<int> group_vertex_;            ///< vertex of the body, by group
  std::vector<Vertex> vertices_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace bem
