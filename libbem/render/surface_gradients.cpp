#include "render/surface_gradients.hpp"

namespace bem {

SurfaceGradients::SurfaceGradients(const TriangleMesh& rest)
    : triangles_(rest.triangles), areas_(rest.vertices.size(), 0) {
  for (const Triangle& t : triangles_) {
    const auto [a, b, c] = triangle_corners(rest, t);
    const Vec3 n = area_vector(a, b, c), t1 = b - a, t2 = c - a;
    const double area = n.norm();
    // area g1 = t2 x n / (2 area), n of length `area`
    bases_.push_back(area > 0 ? Basis{t2.cross(n) / (2 * area), n.cross(t1) / (2 * area), n}
                              : Basis{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
    for (int v : t) areas_[v] += area;
  }
}

std::vector<Mat3> SurfaceGradients::at(const std::vector<Vec3>& positions) const {
  std::vector<Mat3> gradients(areas_.size(), Mat3::Zero());
  for (std::size_t k = 0; k < triangles_.size(); ++k) {
    const auto& [i, j, l] = triangles_[k];
    const Vec3 t1 = positions[j] - positions[i], t2 = positions[l] - positions[i];
    const Basis& rest = bases_[k];
    Mat3 sum = t1 * rest.g1.transpose();
    sum += t2 * rest.g2.transpose();
    sum += t1.cross(t2).normalized() * rest.normal.transpose();
    for (int v : triangles_[k]) gradients[v] += sum;
  }
  for (std::size_t v = 0; v < gradients.size(); ++v)
    gradients[v] = areas_[v] > 0 ? Mat3(gradients[v] / areas_[v]) : Mat3(Mat3::Identity());
  return gradients;
}

}  // namespace bem
