#include "assembly/edge_reconstruction.hpp"

#include "algebra/decompositions.hpp"
#include "base/parallel.hpp"
#include "mesh/adjacency.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Cholesky>

namespace bem {
namespace {

constexpr double kRegularisation = 0.3;  // Lambda, relative to a patch of the edge's size
constexpr int kIterations = 6;           // of iterated Tikhonov regularisation
constexpr double kNoDirection = 1e-6;    // singular values of directions in which a patch is flat

/// Axes of an edge's own coordinates: along it, and two that complete them.
Mat3 edge_axes(const Vec3& along) {
  Mat3 axes;
  axes.row(0) = along;
  axes.row(1) = along.unitOrthogonal();
  axes.row(2) = along.cross(axes.row(1).transpose());
  return axes;
}

/// rho of an edge by its ends a, b and the other vertices of its patch, in this order.
Eigen::VectorXd edge_coefficients(const TriangleMesh& mesh, int a, int b,
                                  const std::vector<int>& patch) {
  const auto n = static_cast<Eigen::Index>(patch.size());
  const Vec3 ends = mesh.vertices[b] - mesh.vertices[a];
  const Vec3 middle = 0.5 * (mesh.vertices[a] + mesh.vertices[b]);
  const double length = ends.norm();
  const Mat3 axes = edge_axes(ends / length);
  Eigen::MatrixXd linear(n, 2), quadratic(n, 6), data = Eigen::MatrixXd::Zero(n, n + 2);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Vec3 x = axes * (mesh.vertices[patch[j]] - middle) / length;
    const double p = x[0], q = x[1], r = x[2], root = std::sqrt(2.0);
    const double w = 1 / std::pow(std::max(x.norm(), 0.5), 2);
    linear.row(j) << w * q, w * r;
    quadratic.row(j) << w * (p * p - 0.25), w * q * q, w * r * r, w * root * p * q,
        w * root * q * r, w * root * p * r;
    data(j, 0) = -w * (0.5 - p);
    data(j, 1) = -w * (0.5 + p);
    data(j, j + 2) = w;
  }
  // what linear fields explain is theirs
  const LeftSingularSystem svd = left_singular_system(linear);
  for (Eigen::Index k = 0; k < svd.values.size(); ++k) {
    if (svd.values[k] <= kNoDirection) continue;
    const Eigen::VectorXd u = svd.vectors.col(k);
    quadratic -= u * (u.transpose() * quadratic).eval();
    data -= u * (u.transpose() * data).eval();
  }
  const Eigen::LDLT<Eigen::MatrixXd> normal(quadratic.transpose() * quadratic +
                                            kRegularisation * kRegularisation *
                                                Eigen::MatrixXd::Identity(6, 6));
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(6, n + 2);
  for (int i = 0; i < kIterations; ++i)
    c += normal.solve(quadratic.transpose() * (data - quadratic * c));
  return -0.25 * c.row(0).transpose();
}

/// The vertices that share a triangle with each vertex, ascending.
std::vector<std::vector<int>> neighbours(const TriangleMesh& mesh) {
  std::vector<std::vector<int>> out(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      out[t[k]].push_back(t[(k + 1) % 3]);
      out[t[k]].push_back(t[(k + 2) % 3]);
    }
  for (std::vector<int>& ring : out) {
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  }
  return out;
}

}  // namespace

MeshEdges::MeshEdges(const std::vector<Triangle>& triangles) : of(triangles.size()) {
  for_each_edge(sorted_half_edges(triangles), [this](const HalfEdge* first, const HalfEdge* last) {
    for (const HalfEdge* e = first; e != last; ++e)
      of[e->index / 3][e->index % 3] = static_cast<int>(vertices.size());
    vertices.push_back({first->low, first->high});
  });
}

EdgeReconstruction::EdgeReconstruction(const TriangleMesh& mesh)
    : edges_(mesh.triangles),
      rho_(static_cast<Eigen::Index>(edges_.size()),
           static_cast<Eigen::Index>(mesh.vertices.size())) {
  const std::vector<std::vector<int>> rings = neighbours(mesh);
  std::vector<std::vector<std::pair<int, double>>> rows(edges_.size());
  parallel_for(edges_.size(), [&](std::size_t e) {
    const auto [a, b] = edges_.vertices[e];
    std::vector<int> patch;
    std::set_union(rings[a].begin(), rings[a].end(), rings[b].begin(), rings[b].end(),
                   std::back_inserter(patch));
    patch.erase(std::remove_if(patch.begin(), patch.end(),
                               [a = a, b = b](int v) { return v == a || v == b; }),
                patch.end());
    if (patch.empty()) return;
    const Eigen::VectorXd rho = edge_coefficients(mesh, a, b, patch);
    rows[e] = {{a, rho[0]}, {b, rho[1]}};
    for (std::size_t j = 0; j < patch.size(); ++j)
      rows[e].emplace_back(patch[j], rho[static_cast<Eigen::Index>(j) + 2]);
  });
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t e = 0; e < rows.size(); ++e)
    for (const auto& [vertex, value] : rows[e])
      entries.emplace_back(static_cast<int>(e), vertex, value);
  rho_.setFromTriplets(entries.begin(), entries.end());
}

TriangleBasis triangle_basis(const TriangleMesh& mesh, const EdgeReconstruction& reconstruction,
                             int triangle) {
  std::map<int, std::array<double, 6>> weights;
  for (int k = 0; k < 3; ++k) weights[mesh.triangles[triangle][k]][k] += 1;
  for (int k = 0; k < 3; ++k) {
    const int e = reconstruction.edges().of[triangle][k];
    using Row = Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator;
    for (Row it(reconstruction.coefficients(), e); it; ++it)
      weights[static_cast<int>(it.col())][3 + k] += it.value();
  }
  TriangleBasis basis;
  for (const auto& [vertex, values] : weights) {
    basis.vertices.push_back(vertex);
    basis.weights.push_back(values);
  }
  return basis;
}

}  // namespace bem
