#include "render/far_binding.hpp"

#include <algorithm>
#include <limits>

#include <Eigen/LU>

namespace bem {
namespace {

constexpr double kLeastDistance = 1e-3;  // over the size, that weights make a difference of

}  // namespace

FarBinding::FarBinding(const TriangleMesh& rest)
    : shares_(rest.vertices.size(), 0), areas_(kPatches, 0), means_(kPatches, Vec3::Zero()) {
  const double least = kLeastDistance * bounding_box(rest.vertices).diagonal();
  least2_ = least * least;
  choose_patches(rest);
  for (const Triangle& t : rest.triangles)
    for (int v : t) shares_[v] += triangle_area(rest, t) / 3;
  for (std::size_t v = 0; v < shares_.size(); ++v) areas_[patch_of_[v]] += shares_[v];
  for (std::size_t v = 0; v < shares_.size(); ++v)
    if (shares_[v] > 0) shares_[v] /= areas_[patch_of_[v]];
  means_ = pose(rest.vertices, std::vector<Mat3>(shares_.size(), Mat3::Identity())).positions;
}

/// Around vertices each of which is as far as possible from those before it.
void FarBinding::choose_patches(const TriangleMesh& rest) {
  patch_of_.assign(rest.vertices.size(), 0);
  std::vector<double> distance2(rest.vertices.size(), std::numeric_limits<double>::infinity());
  std::size_t seed = 0;
  for (std::size_t k = 0; k < kPatches; ++k) {
    const Vec3 centre = rest.vertices[seed];
    for (std::size_t v = 0; v < distance2.size(); ++v) {
      const double here = (rest.vertices[v] - centre).squaredNorm();
      if (here >= distance2[v]) continue;
      distance2[v] = here;
      patch_of_[v] = static_cast<int>(k);
    }
    seed = static_cast<std::size_t>(std::max_element(distance2.begin(), distance2.end()) -
                                    distance2.begin());
  }
}

FarBinding::Point FarBinding::bind(const Vec3& x) const {
  constexpr double kGradients = 1e-6;
  Point point;
  double sum = 0;
  for (std::size_t k = 0; k < kPatches; ++k) {
    const double distance2 = (means_[k] - x).squaredNorm() + least2_;
    point.weights[k] = areas_[k] > 0 ? areas_[k] / (distance2 * distance2) : 0;
    sum += point.weights[k];
  }
  Vec3 mean = Vec3::Zero();
  for (std::size_t k = 0; k < kPatches; ++k) {
    point.weights[k] /= sum;
    mean += point.weights[k] * (means_[k] - x);
  }
  Mat3 spread = Mat3::Zero();
  for (std::size_t k = 0; k < kPatches; ++k) {
    const Vec3 y = means_[k] - x - mean;
    spread += point.weights[k] * y * y.transpose();
  }
  const double gradients = kGradients * spread.trace();
  const Mat3 inverse = (spread + gradients * Mat3::Identity()).inverse();
  const Vec3 slope = -(inverse * mean);
  for (std::size_t k = 0; k < kPatches; ++k)
    point.slopes[k] = point.weights[k] * (means_[k] - x - mean).dot(slope);
  point.lever = gradients * slope;
  return point;
}

FarBinding::Pose FarBinding::pose(const std::vector<Vec3>& positions,
                                  const std::vector<Mat3>& gradients) const {
  Pose pose{std::vector<Vec3>(kPatches, Vec3::Zero()), std::vector<Mat3>(kPatches, Mat3::Zero())};
  for (std::size_t v = 0; v < positions.size(); ++v) {
    pose.positions[patch_of_[v]] += shares_[v] * positions[v];
    pose.gradients[patch_of_[v]] += shares_[v] * gradients[v];
  }
  return pose;
}

Vec3 FarBinding::position(const Pose& pose, const Point& point) {
  Vec3 mean = Vec3::Zero(), difference = Vec3::Zero();
  Mat3 gradient = Mat3::Zero();
  for (std::size_t k = 0; k < kPatches; ++k) {
    mean += point.weights[k] * pose.positions[k];
    gradient += point.weights[k] * pose.gradients[k];
  }
  for (std::size_t k = 0; k < kPatches; ++k)
    difference += point.slopes[k] * (pose.positions[k] - mean);
  return mean + difference + gradient * point.lever;
}

}  // namespace bem
