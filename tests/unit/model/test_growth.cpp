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
  // docs/method.md, "Numerical damping": slowest elastic motion of the 42-vertex icosphere, nu 0.3
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
