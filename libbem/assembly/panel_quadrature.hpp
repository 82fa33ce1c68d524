#pragma once

#include "mesh/triangle_mesh.hpp"
#include "quadrature/rule_choice.hpp"
#include "quadrature/singular.hpp"

#include <vector>

namespace bem {

/// Up to kCapacity quadrature points of one triangle, seen from one collocation point x, as
/// separate arrays. Unused entries up to the next multiple of kPadding repeat a point with weight
/// zero.
struct PointBatch {
  static constexpr int kCapacity = 64;
  static constexpr int kPadding = 16;

  int size = 0;
  bool singular = false;              ///< x is a vertex of the triangle: integrate dp*, not p*
  bool far = false;                   ///< x is more than two edge lengths away
  double r[3][kCapacity];             ///< y - x [m]
  double shape_weight[3][kCapacity];  ///< weight * shape function of the triangle's vertices [m^2]

  void clear() { size = 0; }
  bool has_room(int points) const { return size + points <= kCapacity; }
  void add(const Vec3& offset, const double* shape, double weight) {
    for (int i = 0; i < 3; ++i) {
      r[i][size] = offset[i];
      shape_weight[i][size] = weight * shape[i];
    }
    ++size;
  }
  int padded_size() const { return (size + kPadding - 1) / kPadding * kPadding; }
  void pad();
};

/// Distributes quadrature points over the triangles of a mesh for every collocation vertex: rules
/// chosen by distance, adaptive subdivision close by, polar rule where the vertex belongs to the
/// triangle.
class PanelQuadrature {
 public:
  /// tolerance: relative error per triangle. wave_number: |s|_max/c2 [1/m], 0 for statics.
  /// The mesh must outlive this object.
  PanelQuadrature(const TriangleMesh& mesh, double tolerance, double wave_number);

  /// Calls consume(const PointBatch&) with all points of `triangle` for collocation vertex
  /// `vertex`, in batches that share the triangle's normal. `batch` is scratch space.
  template <class Consume>
  void for_each_batch(int vertex, int triangle, PointBatch& batch, const Consume& consume) const {
    const int corner = corner_of(vertex, triangle);
    batch.clear();
    batch.singular = corner >= 0;
    batch.far = false;
    const auto flush = [&] {
      if (batch.size == 0) return;
      batch.pad();
      consume(static_cast<const PointBatch&>(batch));
      batch.clear();
    };
    if (batch.singular) {
      std::vector<VertexTriangle::Point> points;
      polar_points(vertex, triangle, corner, points);
      for (const VertexTriangle::Point& p : points) {
        if (!batch.has_room(1)) flush();
        double shape[3];  // from "x first" back to the triangle's own numbering
        for (int a = 0; a < 3; ++a) shape[(corner + a) % 3] = p.shape[a];
        batch.add(p.y - mesh_.vertices[vertex], shape, p.weight);
      }
    } else {
      const int rule = far_rule(vertex, triangle);
      batch.far = rule >= 0;
      if (batch.far)
        add_rule(vertex, triangle, rule, batch);
      else
        subdivide(vertex, triangle, batch, flush);
    }
    flush();
  }

  const TriangleMesh& mesh() const { return mesh_; }
  const Vec3& normal(int triangle) const { return panels_[triangle].normal; }

  /// Position of `vertex` in `triangle` (0, 1, 2), or -1.
  int corner_of(int vertex, int triangle) const {
    const Triangle& t = mesh_.triangles[triangle];
    for (int a = 0; a < 3; ++a)
      if (t[a] == vertex) return a;
    return -1;
  }

 private:
  struct Panel {
    Vec3 centroid, normal;
    double area, radius, longest_edge;
  };
  /// A sub-triangle in barycentric coordinates of its triangle.
  struct Cell {
    double corner[3][3];
    int depth;
  };

  int far_rule(int vertex, int triangle) const;
  void add_rule(int vertex, int triangle, int rule, PointBatch& batch) const;
  void add_cell(int vertex, int triangle, const Cell& cell, int rule, PointBatch& batch) const;
  int cell_rule(int vertex, int triangle, const Cell& cell) const;
  static Cell child(const Cell& cell, int index);
  void polar_points(int vertex, int triangle, int corner,
                    std::vector<VertexTriangle::Point>& points) const;

  template <class Flush>
  void subdivide(int vertex, int triangle, PointBatch& batch, const Flush& flush) const {
    std::vector<Cell> stack = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0}};
    while (!stack.empty()) {
      const Cell cell = stack.back();
      stack.pop_back();
      const int rule = cell_rule(vertex, triangle, cell);
      if (rule < 0) {
        for (int i = 3; i >= 0; --i) stack.push_back(child(cell, i));
        continue;
      }
      if (!batch.has_room(triangle_rules()[rule].size)) flush();
      add_cell(vertex, triangle, cell, rule, batch);
    }
  }

  const TriangleMesh& mesh_;
  RuleChoice choice_;
  double tolerance_, wave_number_;
  std::vector<Panel> panels_;
};

}  // namespace bem
