#include "assembly/surface_patch.hpp"

#include "mesh/bisection.hpp"

#include <algorithm>
#include <map>

namespace bem {
namespace {

std::vector<int> sorted_unique(std::vector<int> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

int place_of(const std::vector<int>& sorted, int value) {
  return static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
}

/// See SurfacePatch::curls_at. The hat of corner i has the curl c_i, the bubble of edge (a, b) has
/// 4 (L_a c_b + L_b c_a).
std::array<SparseRows, 3> curls_at_midpoints(const TriangleMesh& mesh, const SurfacePatch& p) {
  using Values = std::map<int, Vec3>;  // by midpoint
  std::vector<Values> of_shapes(p.shape_count);
  const int hats = static_cast<int>(p.hats.size());
  for (std::size_t t = 0; t < p.triangles.size(); ++t) {
    const Triangle& corners = mesh.triangles[p.triangles[t]];
    Vec3 c[3];  // times a third of the area
    for (int i = 0; i < 3; ++i)
      c[i] = (mesh.vertices[corners[(i + 1) % 3]] - mesh.vertices[corners[(i + 2) % 3]]) / 6;
    for (int k = 0; k < 3; ++k) {  // edge from corner k to k + 1; the opposite corner is k + 2
      const int point = p.shapes[t][3 + k] - hats, next = (k + 1) % 3, opposite = (k + 2) % 3;
      const auto add = [&](int shape, const Vec3& value) {
        of_shapes[p.shapes[t][shape]].try_emplace(point, Vec3::Zero()).first->second += value;
      };
      for (int i = 0; i < 3; ++i) add(i, c[i]);
      add(3 + k, 2 * (c[k] + c[next]));
      add(3 + next, 2 * c[opposite]);
      add(3 + opposite, 2 * c[opposite]);
    }
  }
  std::array<SparseRows, 3> out;
  for (int node = 0; node < p.displacements.rows(); ++node) {
    Values of_node;
    for (int k = p.displacements.begin[node]; k < p.displacements.begin[node + 1]; ++k)
      for (const auto& [point, value] : of_shapes[p.displacements.items[k]])
        of_node.try_emplace(point, Vec3::Zero()).first->second += p.displacements.values[k] * value;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<std::pair<int, double>> entries;
      for (const auto& [point, value] : of_node) entries.emplace_back(point, value[axis]);
      out[axis].add_row(entries);
    }
  }
  return out;
}

SurfacePatch make_patch(const TriangleMesh& mesh, const EdgeReconstruction& reconstruction,
                        std::vector<int> triangles) {
  using Row = Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator;
  const auto& rho = reconstruction.coefficients();
  SurfacePatch p;
  p.triangles = std::move(triangles);
  std::vector<int> edges;
  for (int t : p.triangles)
    for (int k = 0; k < 3; ++k) {
      p.hats.push_back(mesh.triangles[t][k]);
      edges.push_back(reconstruction.edges().of[t][k]);
    }
  p.hats = sorted_unique(std::move(p.hats));
  edges = sorted_unique(std::move(edges));
  p.nodes = p.hats;
  for (int e : edges)
    for (Row it(rho, e); it; ++it) p.nodes.push_back(static_cast<int>(it.col()));
  p.nodes = sorted_unique(std::move(p.nodes));
  p.shape_count = static_cast<int>(p.hats.size() + edges.size());

  std::vector<Vec3> corners;
  for (int v : p.hats) corners.push_back(mesh.vertices[v]);
  p.box = bounding_box(corners);
  for (int e : edges) {
    const auto& [a, b] = reconstruction.edges().vertices[e];
    p.midpoints.emplace_back(mesh.vertices[a], mesh.vertices[b]);
  }
  for (int t : p.triangles) {
    const double part = triangle_area(mesh, mesh.triangles[t]) / 3;
    std::array<int, 6> shapes;
    for (int k = 0; k < 3; ++k) {
      const int edge = place_of(edges, reconstruction.edges().of[t][k]);
      shapes[k] = place_of(p.hats, mesh.triangles[t][k]);
      shapes[3 + k] = static_cast<int>(p.hats.size()) + edge;
      p.midpoints[edge].area += part;
      p.midpoints[edge].normal += part * triangle_normal(mesh, mesh.triangles[t]);
    }
    p.shapes.push_back(shapes);
    p.longest_edge = std::max(p.longest_edge, longest_edge(mesh, mesh.triangles[t]));
  }

  // by node: its hat, and what the bubbles owe to it
  std::vector<std::vector<std::pair<int, double>>> shapes(p.nodes.size()), at(p.nodes.size()),
      hats_at(p.hats.size());
  for (std::size_t h = 0; h < p.hats.size(); ++h)
    shapes[place_of(p.nodes, p.hats[h])].emplace_back(static_cast<int>(h), 1.0);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const int number = static_cast<int>(e);
    std::map<int, double> value;  // at the midpoint, by node
    for (Row it(rho, edges[e]); it; ++it) {
      const int node = place_of(p.nodes, static_cast<int>(it.col()));
      if (it.value() == 0) continue;
      shapes[node].emplace_back(static_cast<int>(p.hats.size()) + number, it.value());
      value[node] += it.value();
    }
    for (int v : reconstruction.edges().vertices[edges[e]]) {
      value[place_of(p.nodes, v)] += 0.5;
      hats_at[place_of(p.hats, v)].emplace_back(number, 0.5);
    }
    for (const auto& [node, amount] : value) at[node].emplace_back(number, amount);
  }
  for (std::size_t k = 0; k < p.nodes.size(); ++k) {
    p.displacements.add_row(shapes[k]);
    p.displacements_at.add_row(at[k]);
  }
  for (const auto& entries : hats_at) p.tractions_at.add_row(entries);
  p.curls_at = curls_at_midpoints(mesh, p);
  return p;
}

/// Ranges of the bisected order with at most so many triangles.
void cut(const std::vector<int>& order, int begin, int end, int most,
         std::vector<std::vector<int>>& out) {
  if (end - begin <= most) {
    out.emplace_back(order.begin() + begin, order.begin() + end);
    return;
  }
  const int middle = begin + first_half(end - begin);
  cut(order, begin, middle, most, out);
  cut(order, middle, end, most, out);
}

}  // namespace

void SparseRows::add_row(const std::vector<std::pair<int, double>>& entries) {
  for (const auto& [item, value] : entries) {
    items.push_back(item);
    values.push_back(value);
  }
  begin.push_back(static_cast<int>(items.size()));
}

void SparseRows::add_row(const SparseRows& from, int row) {
  const int first = from.begin[row], last = from.begin[row + 1];
  items.insert(items.end(), from.items.begin() + first, from.items.begin() + last);
  values.insert(values.end(), from.values.begin() + first, from.values.begin() + last);
  begin.push_back(static_cast<int>(items.size()));
}

Eigen::MatrixXd SparseRows::dense(int item_count) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(rows(), item_count);
  for (int row = 0; row < rows(); ++row)
    for (int k = begin[row]; k < begin[row + 1]; ++k) out(row, items[k]) += values[k];
  return out;
}

std::vector<SurfacePatch> make_patches(const TriangleMesh& mesh,
                                       const EdgeReconstruction& reconstruction,
                                       const std::vector<int>& triangles, int most) {
  std::vector<Vec3> centres;
  for (int i : triangles) {
    const Triangle& t = mesh.triangles[i];
    centres.push_back((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3);
  }
  std::vector<int> order = bisection_order(centres);
  for (int& i : order) i = triangles[i];
  std::vector<std::vector<int>> parts;
  cut(order, 0, static_cast<int>(order.size()), most, parts);
  std::vector<SurfacePatch> patches;
  for (std::vector<int>& part : parts)
    patches.push_back(make_patch(mesh, reconstruction, std::move(part)));
  return patches;
}

PatchParts::PatchParts(const TriangleMesh& mesh, const EdgeReconstruction& reconstruction,
                       const SurfacePatch& whole, int most) {
  const auto places = [](const std::vector<int>& of, const std::vector<int>& in) {
    std::vector<int> out;
    for (int value : of) out.push_back(place_of(in, value));
    return out;
  };
  for (SurfacePatch& patch : make_patches(mesh, reconstruction, whole.triangles, most)) {
    std::vector<int> nodes = places(patch.nodes, whole.nodes),
                     hats = places(patch.hats, whole.hats);
    parts.push_back({std::move(patch), std::move(nodes), std::move(hats)});
  }
}

SurfacePatch part_of_patch(const TriangleMesh& mesh, const EdgeReconstruction& reconstruction,
                           const SurfacePatch& patch, std::vector<int> triangles) {
  SurfacePatch part = make_patch(mesh, reconstruction, std::move(triangles));
  part.box = patch.box;
  part.longest_edge = patch.longest_edge;
  return part;
}

}  // namespace bem
