#include "convergence/rigid_fit.hpp"

#include <cmath>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

using namespace bem;

namespace {

const std::vector<Vec3> kRest = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {1, 1, 1}};
const std::vector<double> kWeights = {0.1, 0.3, 0.2, 0.15, 0.25};

}  // namespace

TEST_CASE("A rigid motion is found whatever its angle", "[rigid]") {
  for (double angle : {0.0, 1e-9, 0.7, 3.1415, 6.0}) {
    const Mat3 rotation = Eigen::AngleAxisd(angle, Vec3(1, -2, 0.5).normalized()).matrix();
    std::vector<Vec3> positions;
    for (const Vec3& x : kRest) positions.push_back(rotation * x + Vec3(5, 6, -7));
    const RigidFit fit = fit_rigid_motion(kRest, positions, kWeights);
    CHECK((fit.rotation - rotation).norm() < 1e-12);
    for (std::size_t i = 0; i < kRest.size(); ++i)
      CHECK((fit.centre + fit.rotation * (kRest[i] - fit.rest_centre) - positions[i]).norm() <
            1e-12);
  }
}

TEST_CASE("The fit is the nearest rigid motion", "[rigid]") {
  std::vector<Vec3> positions = kRest;
  positions[1] += Vec3(0.1, 0.2, 0);
  positions[3] += Vec3(0, -0.3, 0.1);
  const RigidFit fit = fit_rigid_motion(kRest, positions, kWeights);
  const auto distance = [&](const Mat3& rotation, const Vec3& centre) {
    double sum = 0;
    for (std::size_t i = 0; i < kRest.size(); ++i)
      sum += kWeights[i] *
             (centre + rotation * (kRest[i] - fit.rest_centre) - positions[i]).squaredNorm();
    return sum;
  };
  const double least = distance(fit.rotation, fit.centre);
  for (int k = 0; k < 3; ++k)
    for (double step : {-1e-3, 1e-3}) {
      CHECK(distance(fit.rotation, fit.centre + step * Vec3::Unit(k)) > least);
      CHECK(distance(Eigen::AngleAxisd(step, Vec3::Unit(k)) * fit.rotation, fit.centre) > least);
    }
}
