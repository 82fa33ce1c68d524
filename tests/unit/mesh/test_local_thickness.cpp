#include "mesh/local_thickness.hpp"
#include "mesh/shapes.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

using namespace bem;

TEST_CASE("a plate is as thick as its faces are apart, over their edges") {
  const TriangleMesh plate = box({1, 1, 0.05}, {5, 5, 1});
  const std::vector<double> thickness = local_thickness(plate);
  REQUIRE(thickness.size() == plate.triangles.size());
  const double edge = 0.2 * std::sqrt(2.0);
  for (std::size_t t = 0; t < thickness.size(); ++t)
    if (std::abs(triangle_normal(plate, plate.triangles[t])[2]) > 0.5)
      CHECK(thickness[t] == Approx(0.05 / edge).epsilon(1e-12));
    else
      CHECK(thickness[t] == 1);  // the opposite edge of the plate is far away
}

TEST_CASE("what is as thick as its triangles are long is not thin") {
  for (const TriangleMesh& mesh : {icosphere(2, 0.5), box({1, 1, 1}, {2, 2, 2})})
    for (double t : local_thickness(mesh)) CHECK(t == 1);
}

TEST_CASE("bodies are thin at sharp rims") {
  TriangleMesh lens = box({1, 1, 1}, {4, 4, 4});
  for (Vec3& v : lens.vertices)  // a cushion whose faces meet at an angle
    v[2] *= 0.02 + 0.4 * (0.5 - std::max(std::abs(v[0]), std::abs(v[1])));
  const std::vector<double> thickness = local_thickness(lens);
  CHECK(*std::min_element(thickness.begin(), thickness.end()) < 0.25);
}
