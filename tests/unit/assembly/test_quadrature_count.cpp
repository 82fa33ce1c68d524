#include "assembly/pair_integrals.hpp"
#include "assembly/quadrature_count.hpp"
#include "mesh/shapes.hpp"

#include <catch2/catch.hpp>

using namespace bem;

namespace {

Discretisation discretisation(SpatialMethod method) {
  Discretisation d;
  d.material.density = 1000;
  d.material.shear_modulus = 1e6;
  d.material.poisson_ratio = 0.3;
  d.scheme = Scheme::parse("radau2");
  d.dt = 0.01;
  d.history_length = 8;
  d.method = method;
  return d;
}

/// Of all pairs of triangles, but for whole ones far from each other.
double near_points_of_all(const TriangleMesh& mesh, const Discretisation& d) {
  const PairIntegrals pairs(mesh, d);
  const int count = static_cast<int>(mesh.triangles.size());
  double points = 0;
  for (int x = 0; x < count; ++x)
    for (int y = 0; y < count; ++y)
      pairs.quadrature().for_each_part(
          x, y, KernelPart::dynamic_part, [&](const PairQuadrature::Part& part) {
            const bool far =
                !part.touching && part.is_whole() && part.rule_x <= 1 && part.rule_y <= 1;
            if (!far)
              pairs.quadrature().for_each_point_of(part, [&](const PairPoint&) { ++points; });
          });
  return points;
}

}  // namespace

TEST_CASE("points of the quadrature are counted, of large meshes by samples") {
  const Discretisation d = discretisation(SpatialMethod::galerkin);
  const std::pair<TriangleMesh, double> cases[] = {
      {icosphere(0, 1), 1e-12}, {icosphere(2, 1), 0.03}, {box({1, 0.2, 0.2}, {10, 2, 2}), 0.1}};
  for (const auto& [mesh, tolerance] : cases) {
    INFO(mesh.triangles.size() << " triangles");
    CHECK(count_quadrature(mesh, d).near_points ==
          Approx(near_points_of_all(mesh, d)).epsilon(tolerance));
  }
}

TEST_CASE("walls that are thin for their triangles take many points") {
  for (const SpatialMethod method : {SpatialMethod::galerkin, SpatialMethod::collocation}) {
    const Discretisation d = discretisation(method);
    const auto near_points = [&](double thickness) {
      return count_quadrature(box({1, 1, thickness}, {8, 8, 1}), d).near_points;
    };
    CHECK(near_points(0.01) > 1.5 * near_points(0.1));
  }
}

TEST_CASE("very many points are not gone through") {
  TriangleMesh slit = box({1, 1, 1}, {4, 4, 4});  // two cubes, a millionth apart
  const TriangleMesh other = slit;
  const int first = static_cast<int>(slit.vertices.size());
  for (const Vec3& v : other.vertices) slit.vertices.emplace_back(v[0], v[1], v[2] + 1 + 1e-6);
  for (const Triangle& t : other.triangles)
    slit.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  CHECK(count_quadrature(slit, discretisation(SpatialMethod::galerkin)).near_points > 3e6);
}
