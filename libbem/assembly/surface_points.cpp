#include "assembly/surface_points.hpp"

#include <algorithm>

namespace bem {
namespace {

using SparseMatrix = SurfacePoints::SparseMatrix;
using Entry = Eigen::Triplet<double>;

SparseMatrix sparse(Eigen::Index rows, Eigen::Index columns, const std::vector<Entry>& entries) {
  SparseMatrix out(rows, columns);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// Some rows of a matrix, whose columns are all among the ascending `columns`.
SparseRows some_rows(const SparseMatrix& from, int begin, int end,
                     const std::vector<int>& columns) {
  SparseRows out;
  std::vector<std::pair<int, double>> entries;
  for (int row = begin; row < end; ++row) {
    entries.clear();
    for (SparseMatrix::InnerIterator it(from, row); it; ++it) {
      const auto place = std::lower_bound(columns.begin(), columns.end(), it.col());
      entries.emplace_back(static_cast<int>(place - columns.begin()), it.value());
    }
    out.add_row(entries);
  }
  return out;
}

}  // namespace

SurfacePoints::SurfacePoints(const TriangleMesh& mesh, const EdgeReconstruction& reconstruction) {
  const auto nodes = static_cast<Eigen::Index>(mesh.vertices.size()),
             edges = static_cast<Eigen::Index>(reconstruction.edges().size());
  const SparseMatrix bubbles = reconstruction.coefficients().transpose();
  std::vector<Entry> halves;
  for (const auto& [a, b] : reconstruction.edges().vertices) {
    const auto e = static_cast<int>(points.size());
    points.emplace_back(mesh.vertices[a], mesh.vertices[b]);
    for (int v : {a, b}) halves.emplace_back(v, e, 0.5);
  }
  tractions_at = sparse(nodes, edges, halves);
  displacements_at = tractions_at + bubbles;

  // of hats, and of bubbles by their edges: see SurfacePatch::curls_at
  std::array<std::vector<Entry>, 3> of_hats, of_bubbles;
  boxes.resize(nodes);
  longest_edges.assign(nodes, 0.0);
  std::vector<char> reached(nodes, 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& corners = mesh.triangles[t];
    const std::array<int, 3>& own = reconstruction.edges().of[t];
    const double part = triangle_area(mesh, corners) / 3;
    const Vec3 normal = triangle_normal(mesh, corners);
    Vec3 c[3];
    for (int i = 0; i < 3; ++i)
      c[i] = (mesh.vertices[corners[(i + 1) % 3]] - mesh.vertices[corners[(i + 2) % 3]]) / 6;
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3, opposite = (k + 2) % 3;
      points[own[k]].area += part;
      points[own[k]].normal += part * normal;
      for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 3; ++i) of_hats[axis].emplace_back(corners[i], own[k], c[i][axis]);
        auto& to = of_bubbles[axis];
        to.emplace_back(own[k], own[k], 2 * (c[k] + c[next])[axis]);
        to.emplace_back(own[next], own[k], 2 * c[opposite][axis]);
        to.emplace_back(own[opposite], own[k], 2 * c[opposite][axis]);
      }
    }
    const BoundingBox box = bounding_box(
        {mesh.vertices[corners[0]], mesh.vertices[corners[1]], mesh.vertices[corners[2]]});
    for (int node : triangle_basis(mesh, reconstruction, static_cast<int>(t)).vertices) {
      if (reached[node] == 0) boxes[node] = box;
      reached[node] = 1;
      extend(boxes[node], box);
      longest_edges[node] = std::max(longest_edges[node], longest_edge(mesh, corners));
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const SparseMatrix by_bubble = bubbles * sparse(edges, edges, of_bubbles[axis]);
    curls_at[axis] = sparse(nodes, edges, of_hats[axis]) + by_bubble;
  }
}

PointCluster::PointCluster(const SurfacePoints& surface, int first, int last)
    : begin(first), end(last) {
  for (int node = begin; node < end; ++node)
    for (SparseMatrix::InnerIterator it(surface.displacements_at, node); it; ++it)
      points.push_back(static_cast<int>(it.col()));
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  displacements_at = some_rows(surface.displacements_at, begin, end, points);
  tractions_at = some_rows(surface.tractions_at, begin, end, points);
}

ClusterExtent::ClusterExtent(const SurfacePoints& surface, int begin, int end) {
  box = surface.boxes[begin];
  for (int node = begin; node < end; ++node) {
    extend(box, surface.boxes[node]);
    longest_edge = std::max(longest_edge, surface.longest_edges[node]);
  }
}

}  // namespace bem
