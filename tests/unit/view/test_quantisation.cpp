#include "quantisation.hpp"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace bem;

TEST_CASE("positions are within half a step of their grid", "[quantisation]") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> along(-3, 5);
  std::vector<double> points(3000);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = i % 3 == 2 ? 0.25 : along(random);
  PositionGrid grid;
  grid.include(points);
  const std::vector<std::uint16_t> levels = grid.quantised(points);
  double worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double back = grid.origin()[i % 3] + grid.step()[i % 3] * levels[i];
    worst = std::max(worst, std::abs(back - points[i]));
  }
  const double longest = grid.step().maxCoeff() * PositionGrid::kLevels;
  CHECK(longest > 7.9);
  CHECK(worst <= longest / 131070 * (1 + 1e-9));
  CHECK(worst > 0.9 * longest / 131070);
}

TEST_CASE("values are within half a step of theirs", "[quantisation]") {
  const ValueGrid grid{90};
  for (double value : {0.0, 0.01, 33.3, 89.99, 90.0}) {
    const double back = grid.quantised({value})[0] * 90.0 / ValueGrid::kLevels;
    CHECK(std::abs(back - value) <= 90.0 / 8190 * (1 + 1e-9));
  }
  CHECK(ValueGrid{0}.quantised({0, 0}) == std::vector<std::uint16_t>{0, 0});
}

TEST_CASE("a pose and local points are where the points were", "[quantisation]") {
  const Vec3 translation(10, -3, 2);
  const Eigen::Quaterniond turn = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized();
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation = turn.toRotationMatrix();
  const Pose pose(translation.data(), rotation.data());
  std::vector<float> numbers;
  pose.append_to(numbers);
  REQUIRE(numbers.size() == 7);
  const Eigen::Quaterniond stored =
      Eigen::Quaternionf(numbers[6], numbers[3], numbers[4], numbers[5]).cast<double>();
  const std::vector<double> local = pose.to_local({11, 0, -1});
  const Vec3 back = stored.normalized() * Vec3(local[0], local[1], local[2]) +
                    Vec3(numbers[0], numbers[1], numbers[2]);
  CHECK((back - Vec3(11, 0, -1)).norm() < 1e-12);
}
