#include "quantisation.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

std::uint16_t level(double value, double step, int levels) {
  const double number = step > 0 ? std::round(value / step) : 0;
  return static_cast<std::uint16_t>(std::clamp<double>(number, 0, levels));
}

}  // namespace

void PositionGrid::include(const std::vector<double>& points) {
  for (std::size_t i = 0; i < points.size(); i += 3) {
    const Eigen::Map<const Vec3> p(points.data() + i);
    least_ = least_.cwiseMin(p);
    most_ = most_.cwiseMax(p);
  }
}

std::vector<std::uint16_t> PositionGrid::quantised(const std::vector<double>& points) const {
  const Vec3 width = step();
  std::vector<std::uint16_t> out(points.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = level(points[i] - least_[i % 3], width[i % 3], kLevels);
  return out;
}

std::vector<std::uint16_t> ValueGrid::quantised(const std::vector<double>& values) const {
  std::vector<std::uint16_t> out(values.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = level(values[i], most / kLevels, kLevels);
  return out;
}

Pose::Pose(const double* translation, const double* rotation)
    : translation_(Eigen::Map<const Vec3>(translation).cast<float>()) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> matrix(rotation);
  rotation_ = Eigen::Quaterniond(Mat3(matrix)).normalized().cast<float>();
}

std::vector<double> Pose::to_local(std::vector<double> points) const {
  const Mat3 inverse = rotation_.cast<double>().normalized().toRotationMatrix().transpose();
  const Vec3 origin = translation_.cast<double>();
  for (std::size_t i = 0; i < points.size(); i += 3) {
    Eigen::Map<Vec3> p(points.data() + i);
    p = (inverse * (p - origin)).eval();
  }
  return points;
}

void Pose::append_to(std::vector<float>& numbers) const {
  for (int i = 0; i < 3; ++i) numbers.push_back(translation_[i]);
  for (int i = 0; i < 4; ++i) numbers.push_back(rotation_.coeffs()[i]);
}

}  // namespace bem
