#include "quadrature/free_term.hpp"

#include <cmath>

namespace bem {
namespace {

Vec3 face_normal(const Vec3& x, const std::vector<Vec3>& ring, std::size_t i) {
  return (ring[i] - x).cross(ring[(i + 1) % ring.size()] - x).normalized();
}

}  // namespace

double interior_solid_angle(const Vec3& x, const std::vector<Vec3>& ring) {
  double omega = 2 * kPi;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    // the edge towards ring[i] leaves x counter-clockwise in face i and clockwise in face i-1
    const Vec3 e = (ring[i] - x).normalized();
    const Vec3 f = face_normal(x, ring, i);
    const Vec3 g = face_normal(x, ring, (i + ring.size() - 1) % ring.size());
    omega -= std::atan2(f.cross(g).dot(e), f.dot(g));
  }
  return omega;
}

Mat3 free_term(const Vec3& x, const std::vector<Vec3>& ring, double kappa) {
  Mat3 sum = Mat3::Zero();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 ea = (ring[i] - x).normalized();
    const Vec3 eb = (ring[(i + 1) % ring.size()] - x).normalized();
    const Vec3 n = ea.cross(eb).normalized();
    sum += (eb - ea).cross(n) * n.transpose();
  }
  return interior_solid_angle(x, ring) / (4 * kPi) * Mat3::Identity() -
         (1 - kappa) / (4 * kPi) * sum;
}

}  // namespace bem
