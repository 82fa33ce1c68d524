#include "handover/animated_scene.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

/// From sRGB, 8 bits per channel.
Vec3 linear_colour(unsigned rgb) {
  Vec3 out;
  for (int i = 0; i < 3; ++i) {
    const double c = static_cast<double>(rgb >> (16 - 8 * i) & 255U) / 255;
    out[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  return out;
}

}  // namespace

void AnimatedBody::set_triangles(const std::vector<Triangle>& triangles) {
  corners.clear();
  starts = {0};
  for (const Triangle& t : triangles) {
    corners.insert(corners.end(), t.begin(), t.end());
    starts.push_back(corners.size());
  }
}

std::vector<double> coordinates(const std::vector<Vec3>& points) {
  std::vector<double> out;
  for (const Vec3& p : points) out.insert(out.end(), p.data(), p.data() + 3);
  return out;
}

VectorRange::VectorRange(const std::vector<double>& numbers)
    : least(3, HUGE_VAL), most(3, -HUGE_VAL) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    least[i % 3] = std::min(least[i % 3], numbers[i]);
    most[i % 3] = std::max(most[i % 3], numbers[i]);
  }
}

double VectorRange::largest() const {
  double out = 0;
  for (int i = 0; i < 3; ++i) out = std::max({out, std::abs(least[i]), std::abs(most[i])});
  return out;
}

double frame_rate(const std::vector<double>& times) {
  constexpr double kUsual = 24, kNear = 0.01;
  if (times.size() < 2) return kUsual;
  const double rate = static_cast<double>(times.size() - 1) / (times.back() - times.front()),
               whole = std::round(rate);
  return std::abs(rate - whole) <= kNear * rate ? whole : rate;
}

Vec3 body_colour(std::size_t body) {
  constexpr unsigned kColours[] = {0xff7d6b, 0x2fb5a6, 0xf6b13d, 0x8a7df0,
                                   0x4a9cee, 0xec74aa, 0x74bf60, 0xc98d62};
  return linear_colour(kColours[body % std::size(kColours)]);
}

Vec3 obstacle_colour() {
  return linear_colour(0xb9b9b4);
}

}  // namespace bem
