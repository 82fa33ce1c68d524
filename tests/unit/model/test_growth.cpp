#include "model/growth.hpp"
#include "support/models.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

double growth(const TriangleMesh& mesh, double nu, const char* scheme, double lam,
              int history = 0) {
  const Material m = material(1000, 1e6, nu);
  const BodyGeometry g = geometry_of(mesh, m.density);
  PrecomputeOptions o = options_for(g, m, scheme, lam);
  if (history > 0) o.discretisation.history_length = history;
  return growth_factor(precompute(g, o)).factor;
}

}  // namespace

TEST_CASE("growth factors of the free recursion agree with an independent implementation") {
  // slowest elastic motion of the 42-vertex icosphere, nu 0.3
  const TriangleMesh sphere = icosphere(1, 0.5);
  const struct {
    const char* scheme;
    double lam, factor;
  } table[] = {{"bdf1", 6.5, 0.764},   {"bdf1", 14.5, 0.932},   {"bdf2", 3.5, 0.832},
               {"bdf2", 6.5, 0.948},   {"radau2", 1.5, 0.572},  {"radau2", 3.5, 0.920},
               {"radau2", 6.5, 0.984}, {"radau2", 12.5, 1.0002}};
  for (const auto& row : table) {
    INFO(row.scheme << ", lam " << row.lam);
    // a history long enough to hold all weights, as in the table
    const int all = static_cast<int>(row.lam + 10 * std::sqrt(row.lam) + 15);
    CHECK(growth(sphere, 0.3, row.scheme, row.lam, all) == Approx(row.factor).margin(0.0015));
  }
}

TEST_CASE("motions that grow slowly among many that hardly decay are found") {
  // each factor was confirmed by the growth of a kicked body over 1500 to 4000 steps (within 5e-4)
  const struct {
    TriangleMesh mesh;
    double nu, lam, factor;
  } table[] = {{bowl(0.5, 0.05, 16), 0.45, 12.5, 1.0222},
               {box(Vec3(1, 1, 1), {3, 3, 3}), 0, 12.5, 1.0072},
               {box(Vec3(0.3, 0.2, 0.1), {6, 4, 2}), 0.3, 12.5, 1.0079}};
  for (const auto& row : table) {
    INFO("nu " << row.nu << ", lam " << row.lam);
    CHECK(growth(row.mesh, row.nu, "radau2", row.lam) == Approx(row.factor).margin(2e-4));
  }
}

TEST_CASE("the search may restart with one motion more than usual") {
  // A thick sheet whose largest motions are split in the middle of a conjugate pair; confirmed as
  // above.
  const Material m = material(1000, 1e6, 0.3);
  const BodyGeometry g = geometry_of(box(Vec3(0.05, 0.6, 0.6), {1, 5, 5}), m.density);
  PrecomputeOptions o = options_for(g, m, "theta:0.75", g.extent / (m.shear_speed() * 1e-3));
  const GrowthEstimate estimate = growth_factor(precompute(g, o));
  CHECK(estimate.steps > 100);
  CHECK(estimate.residual < 1e-4);
  CHECK(estimate.factor == Approx(1).margin(0.02));
}
