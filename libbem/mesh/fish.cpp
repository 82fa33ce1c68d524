#include "base/error.hpp"
#include "mesh/grid_shapes.hpp"
#include "mesh/shapes.hpp"

#include <cmath>

namespace bem {
namespace {

/// Half a cross-section of the fish of length 1.
struct Section {
  double height = 0, width = 0;

  double mean_radius() const { return std::sqrt(0.5 * (height * height + width * width)); }
};

constexpr double kTailStart = 0.74;

double smooth_step(double t) {
  t = std::fmin(std::fmax(t, 0.0), 1.0);
  return t * t * (3 - 2 * t);
}

/// Share of the tail fin in the section at `s` from the nose (0) to the tips of the tail (1).
double tail(double s) {
  return smooth_step((s - kTailStart) / (1 - kTailStart));
}

/// The body is a symmetric wing section (NACA), the tail grows high and thin behind it, and both
/// ends are round.
Section section(double s) {
  const double t = s / 0.85;
  const double wing =
      t < 1
          ? 10 * (0.2969 * std::sqrt(t) - 0.126 * t + t * t * (-0.3516 + t * (0.2843 - 0.1036 * t)))
          : 0;
  const auto round = [](double distance, double length) {
    const double u = std::fmax(0.0, 1 - distance / length);
    return std::sqrt(std::fmax(0.0, 1 - u * u));
  };
  const double ends = round(s, 0.1) * round(1 - s, 0.04);
  return {ends * std::hypot(0.18 * wing, 0.035 + 0.13 * tail(s)),
          ends * std::hypot(0.11 * wing, 0.025)};
}

/// Stations from the tail to the nose at equal distances along the mean outline.
std::vector<double> stations(double spacing) {
  constexpr int kSamples = 20000;
  std::vector<double> way{0};
  for (int i = 1; i <= kSamples; ++i)
    way.push_back(way.back() + std::hypot(section(double(i) / kSamples).mean_radius() -
                                              section(double(i - 1) / kSamples).mean_radius(),
                                          1.0 / kSamples));
  const int count = std::max(8, static_cast<int>(std::lround(way.back() / spacing)));
  std::vector<double> result{1};
  for (int k = 1, i = kSamples; k < count; ++k) {
    while (way[i] > way.back() * (count - k) / count) --i;
    result.push_back(double(i) / kSamples);
  }
  result.push_back(0);
  return result;
}

}  // namespace

TriangleMesh fish(double length, int segments) {
  if (!std::isfinite(length) || length <= 0)
    throw Error(ErrorCode::usage, "shape: length must be positive");
  if (segments < 8 || segments > 1000)
    throw Error(ErrorCode::usage, "shape: a fish needs 8 to 1000 segments");
  double girth = 0;
  for (int i = 0; i <= 100; ++i) girth = std::fmax(girth, section(0.01 * i).mean_radius());
  std::vector<MeridianPoint> profile;
  for (double s : stations(2 * kPi * girth / segments))
    profile.push_back({s > 0 && s < 1 ? section(s).mean_radius() : 0.0, 1 - s});
  TriangleMesh mesh = revolve(profile, segments);
  for (Vec3& v : mesh.vertices) {
    const double s = 1 - v[2], r = std::hypot(v[0], v[1]);
    const double c = r > 0 ? v[0] / r : 0, d = r > 0 ? v[1] / r : 0;
    const Section here = section(s);
    const double height = here.height * d;
    // The tips of the tail are behind its middle.
    const double behind = 0.2 * tail(s) * (std::pow(height / 0.15, 2) - 0.5);
    v = length * Vec3(0.5 - s - behind, here.width * c, height);
  }
  return mesh;
}

}  // namespace bem
