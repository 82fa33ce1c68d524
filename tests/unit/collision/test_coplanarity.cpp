#include "collision/coplanarity.hpp"
#include "collision_test.hpp"

#include <algorithm>
#include <random>

using namespace bem;

TEST_CASE("sign changes of cubics with known roots") {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> uniform(-0.5, 1.5);
  int counts[4] = {0, 0, 0, 0};
  for (int i = 0; i < 2000; ++i) {
    std::array<double, 3> roots = {uniform(generator), uniform(generator), uniform(generator)};
    std::sort(roots.begin(), roots.end());
    const double scale = i % 2 == 0 ? 1e-9 : -3;
    const auto [r, s, t] = roots;
    const Cubic f{
        {-scale * r * s * t, scale * (r * s + s * t + t * r), -scale * (r + s + t), scale}};
    const Crossings found = sign_changes(f);
    int k = 0;
    bool positive = scale < 0;
    for (double root : roots) {
      positive = !positive;
      if (root <= 0 || root >= 1) continue;
      REQUIRE(k < found.count);
      CHECK(std::abs(found.at[k].time - root) < 1e-7);
      CHECK(found.at[k].falling == !positive);
      ++k;
    }
    REQUIRE(found.count == k);
    ++counts[k];
  }
  for (int n : counts) CHECK(n > 50);
}

TEST_CASE("sign changes of lower degrees and of nothing") {
  CHECK(sign_changes({{0, 0, 0, 0}}).count == 0);
  CHECK(sign_changes({{1, 0, 0, 0}}).count == 0);
  CHECK(sign_changes({{0.2501, -1, 1, 0}}).count == 0);  // just above zero at 1/2
  const Crossings line = sign_changes({{0.3, -1, 0, 0}});
  REQUIRE(line.count == 1);
  CHECK(line.at[0].time == Approx(0.3).epsilon(1e-15));
  CHECK(line.at[0].falling);
  const Crossings parabola = sign_changes({{0.16, -1, 1, 0}});  // 0.2 and 0.8
  REQUIRE(parabola.count == 2);
  CHECK(parabola.at[0].time == Approx(0.2));
  CHECK(parabola.at[1].time == Approx(0.8));
  CHECK_FALSE(parabola.at[1].falling);
}

TEST_CASE("the triple product is evaluated as a polynomial") {
  const LinearVector w{{1, 2, -1}, {0.3, -1, 2}}, u{{0, 1, 1}, {1, 1, -0.5}},
      v{{2, 0, 1}, {-1, 0.2, 0.1}};
  const Cubic f = triple_product(w, u, v);
  for (double t : {0.0, 0.3, 0.77, 1.0})
    CHECK(f(t) == Approx((w.start + t * w.change)
                             .dot((u.start + t * u.change).cross(v.start + t * v.change))));
}
