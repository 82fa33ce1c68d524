#include "assembly/panel_quadrature.hpp"

#include "mesh/closest_points.hpp"

#include <algorithm>

namespace bem {
namespace {

// a vertex closer than 1e-4 edges is integrated with the finest rule
constexpr int kDeepestCell = 12;

}  // namespace

void PointBatch::pad() {
  const int end = std::min(padded_size(), kCapacity);
  for (int q = size; q < end; ++q)
    for (int i = 0; i < 3; ++i) {
      r[i][q] = r[i][0];
      shape_weight[i][q] = 0;
    }
}

PanelQuadrature::PanelQuadrature(const TriangleMesh& mesh, double tolerance, double wave_number)
    : mesh_(mesh), choice_(tolerance), tolerance_(tolerance), wave_number_(wave_number) {
  panels_.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    Panel p;
    p.centroid = triangle_centroid(mesh, t);
    p.normal = triangle_normal(mesh, t);
    p.area = triangle_area(mesh, t);
    p.longest_edge = longest_edge(mesh, t);
    p.radius = 0;
    for (int v : t) p.radius = std::max(p.radius, (mesh.vertices[v] - p.centroid).norm());
    panels_.push_back(p);
  }
}

int PanelQuadrature::far_rule(int vertex, int triangle) const {
  const Panel& p = panels_[triangle];
  const double lower_bound = (mesh_.vertices[vertex] - p.centroid).norm() - p.radius;
  // the bound is only good enough where it already says "far"
  if (lower_bound < 2 * p.longest_edge) return -1;
  return choice_.choose(lower_bound / p.longest_edge, wave_number_ * p.longest_edge);
}

void PanelQuadrature::add_rule(int vertex, int triangle, int rule, PointBatch& batch) const {
  const Triangle& t = mesh_.triangles[triangle];
  const Vec3& x = mesh_.vertices[vertex];
  const Vec3 a = mesh_.vertices[t[0]] - x, b = mesh_.vertices[t[1]] - x,
             c = mesh_.vertices[t[2]] - x;
  const TriangleRule& points = triangle_rules()[rule];
  for (int q = 0; q < points.size; ++q) {
    const double* w = points.points[q].barycentric;
    batch.add(w[0] * a + w[1] * b + w[2] * c, w, points.points[q].weight * panels_[triangle].area);
  }
}

int PanelQuadrature::cell_rule(int vertex, int triangle, const Cell& cell) const {
  const Triangle& t = mesh_.triangles[triangle];
  Vec3 corner[3];
  for (int i = 0; i < 3; ++i)
    corner[i] = cell.corner[i][0] * mesh_.vertices[t[0]] +
                cell.corner[i][1] * mesh_.vertices[t[1]] + cell.corner[i][2] * mesh_.vertices[t[2]];
  const double longest = panels_[triangle].longest_edge / (1 << cell.depth);
  const double distance =
      point_triangle_distance(mesh_.vertices[vertex], corner[0], corner[1], corner[2]);
  const int rule = choice_.choose(distance / longest, wave_number_ * longest);
  return rule < 0 && cell.depth >= kDeepestCell ? kTriangleRuleCount - 1 : rule;
}

void PanelQuadrature::add_cell(int vertex, int triangle, const Cell& cell, int rule,
                               PointBatch& batch) const {
  const Triangle& t = mesh_.triangles[triangle];
  const Vec3& x = mesh_.vertices[vertex];
  const Vec3 edge[3] = {mesh_.vertices[t[0]] - x, mesh_.vertices[t[1]] - x,
                        mesh_.vertices[t[2]] - x};
  const double area = panels_[triangle].area / static_cast<double>(1 << (2 * cell.depth));
  const TriangleRule& points = triangle_rules()[rule];
  for (int q = 0; q < points.size; ++q) {
    const double* w = points.points[q].barycentric;
    double shape[3];
    for (int a = 0; a < 3; ++a)
      shape[a] = w[0] * cell.corner[0][a] + w[1] * cell.corner[1][a] + w[2] * cell.corner[2][a];
    batch.add(shape[0] * edge[0] + shape[1] * edge[1] + shape[2] * edge[2], shape,
              points.points[q].weight * area);
  }
}

PanelQuadrature::Cell PanelQuadrature::child(const Cell& cell, int index) {
  const auto middle = [&cell](int i, int j, int a) {
    return 0.5 * (cell.corner[i][a] + cell.corner[j][a]);
  };
  Cell c;
  c.depth = cell.depth + 1;
  for (int a = 0; a < 3; ++a) {
    if (index == 3) {
      for (int i = 0; i < 3; ++i) c.corner[i][a] = middle(i, (i + 1) % 3, a);
    } else {
      c.corner[0][a] = cell.corner[index][a];
      c.corner[1][a] = middle(index, (index + 1) % 3, a);
      c.corner[2][a] = middle(index, (index + 2) % 3, a);
    }
  }
  return c;
}

void PanelQuadrature::polar_points(int vertex, int triangle, int corner,
                                   std::vector<VertexTriangle::Point>& points) const {
  const Triangle& t = mesh_.triangles[triangle];
  const VertexTriangle geometry(mesh_.vertices[vertex], mesh_.vertices[t[(corner + 1) % 3]],
                                mesh_.vertices[t[(corner + 2) % 3]]);
  const PolarOrder order =
      polar_order(tolerance_, geometry.angle(), wave_number_ * panels_[triangle].longest_edge);
  geometry.polar_points(order.angular, order.radial, points);
}

}  // namespace bem
