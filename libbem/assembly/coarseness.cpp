#include "assembly/coarseness.hpp"

#include <algorithm>
#include <numeric>

namespace bem {
namespace {

std::vector<double> triangle_areas(const TriangleMesh& mesh) {
  std::vector<double> out;
  for (const Triangle& t : mesh.triangles) out.push_back(triangle_area(mesh, t));
  return out;
}

/// int |u|^2 dA / area by the values at the corners and the bubbles of edges (0, 1), (1, 2), (2,
/// 0).
double field_square(const std::array<Vec3, 3>& u, const std::array<Vec3, 3>& b) {
  const Vec3 values = u[0] + u[1] + u[2], sum = b[0] + b[1] + b[2];
  double squares = values.squaredNorm(), products = 2 * values.dot(sum);
  for (int k = 0; k < 3; ++k) {
    squares += u[k].squaredNorm();
    products -= b[k].dot(u[(k + 2) % 3]);  // of the corner opposite to the edge
  }
  return squares / 12 + 2 * products / 15 + bubble_square(b[0], b[1], b[2]);
}

}  // namespace

Eigen::Matrix<double, 6, 6> quadratic_mass() {
  Eigen::Matrix<double, 6, 6> m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      m(i, j) = (i == j ? 2 : 1) / 12.0;
      m(3 + i, 3 + j) = (i == j ? 8 : 4) / 45.0;
      m(i, 3 + j) = m(3 + j, i) = (i == (j + 2) % 3 ? 1 : 2) / 15.0;
    }
  return m;
}

Coarseness::Coarseness(TriangleMesh mesh)
    : mesh_(std::move(mesh)), reconstruction_(mesh_), areas_(triangle_areas(mesh_)) {
  for (std::size_t t = 0; t < areas_.size(); ++t) {
    area_ += areas_[t];
    centre_ += areas_[t] * triangle_centroid(mesh_, mesh_.triangles[t]);
  }
  centre_ /= area_;
  const auto vertices = static_cast<Eigen::Index>(mesh_.vertices.size());
  const auto edges = static_cast<Eigen::Index>(reconstruction_.edges().size());
  weights_.setZero(vertices, 4);
  Eigen::Matrix<double, Eigen::Dynamic, 4> of_edges = Eigen::MatrixXd::Zero(edges, 4);
  Mat3 second = Mat3::Zero();
  for (std::size_t t = 0; t < areas_.size(); ++t) {
    std::array<Eigen::RowVector4d, 3> corners;
    for (int k = 0; k < 3; ++k)
      corners[k] << 1, (mesh_.vertices[mesh_.triangles[t][k]] - centre_).transpose();
    const Eigen::RowVector4d sum = corners[0] + corners[1] + corners[2];
    second += areas_[t] / 12 * sum.tail<3>().transpose() * sum.tail<3>();
    for (int k = 0; k < 3; ++k) {
      weights_.row(mesh_.triangles[t][k]) += areas_[t] / 12 * (sum + corners[k]);
      of_edges.row(reconstruction_.edges().of[t][k]) +=
          areas_[t] / 15 * (2 * sum - corners[(k + 2) % 3]);
      second += areas_[t] / 12 * corners[k].tail<3>().transpose() * corners[k].tail<3>();
    }
  }
  weights_ += reconstruction_.coefficients().transpose() * of_edges;
  inverse_inertia_ = (second.trace() * Mat3::Identity() - second).inverse();
}

VectorRows Coarseness::without_rigid_motion(const Eigen::VectorXd& displacement) const {
  VectorRows out = Eigen::Map<const VectorRows>(displacement.data(), displacement.size() / 3, 3);
  Vec3 translation = Vec3::Zero(), moment = Vec3::Zero();
  for (Eigen::Index i = 0; i < out.rows(); ++i) {
    const Vec3 u = out.row(i), arm = weights_.row(i).tail<3>();
    translation += weights_(i, 0) * u;
    moment += arm.cross(u);
  }
  translation /= area_;
  const Vec3 rotation = inverse_inertia_ * moment;
  for (Eigen::Index i = 0; i < out.rows(); ++i)
    out.row(i) -= translation + rotation.cross(mesh_.vertices[i] - centre_);
  return out;
}

VectorRows Coarseness::bubbles(const VectorRows& values) const {
  const auto& rho = reconstruction_.coefficients();
  VectorRows out(rho.rows(), 3);
  for (Eigen::Index e = 0; e < rho.rows(); ++e) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (int k = rho.outerIndexPtr()[e]; k < rho.outerIndexPtr()[e + 1]; ++k)
      sum += rho.valuePtr()[k] * values.row(rho.innerIndexPtr()[k]);
    out.row(e) = sum;
  }
  return out;
}

FieldNorms Coarseness::norms(const Eigen::VectorXd& displacement) const {
  const VectorRows values = without_rigid_motion(displacement), bubble = bubbles(values);
  FieldNorms squares;
  for (std::size_t t = 0; t < areas_.size(); ++t) {
    std::array<Vec3, 3> u, b;
    for (int k = 0; k < 3; ++k) {
      u[k] = values.row(mesh_.triangles[t][k]);
      b[k] = bubble.row(reconstruction_.edges().of[t][k]);
    }
    squares.bubbles += areas_[t] * bubble_square(b[0], b[1], b[2]);
    squares.deformation += areas_[t] * field_square(u, b);
  }
  return {std::sqrt(squares.bubbles), std::sqrt(std::max(squares.deformation, 0.0))};
}

WorstEdge Coarseness::worst_edge(const Eigen::VectorXd& displacement) const {
  const VectorRows bubble = bubbles(without_rigid_motion(displacement));
  Eigen::Index worst = 0;
  WorstEdge out;
  out.bubble = bubble.rowwise().norm().maxCoeff(&worst);
  out.vertices = reconstruction_.edges().vertices[worst];
  out.midpoint = 0.5 * (mesh_.vertices[out.vertices[0]] + mesh_.vertices[out.vertices[1]]);
  return out;
}

Refinement Coarseness::halving(const Eigen::VectorXd& displacement) const {
  constexpr double kShare = 0.8;  // of the squares
  const VectorRows bubble = bubbles(without_rigid_motion(displacement));
  const std::vector<std::array<int, 3>>& edges_of = reconstruction_.edges().of;
  std::vector<double> squares;
  double left = 0;
  for (std::size_t t = 0; t < areas_.size(); ++t) {
    const auto [a, b, c] = edges_of[t];
    squares.push_back(areas_[t] * bubble_square(bubble.row(a), bubble.row(b), bubble.row(c)));
    left += kShare * squares.back();
  }
  std::vector<std::size_t> order(squares.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t s, std::size_t t) { return squares[s] > squares[t]; });
  Refinement out;
  out.nodes = mesh_.vertices.size();
  std::vector<char> halved(reconstruction_.edges().size(), 0);
  for (std::size_t t : order) {
    if (!(left > 0)) break;
    left -= squares[t];
    ++out.triangles;
    for (int e : edges_of[t]) {
      out.nodes += !halved[e];
      halved[e] = 1;
    }
  }
  return out;
}

}  // namespace bem
