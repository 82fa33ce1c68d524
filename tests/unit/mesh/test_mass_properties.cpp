#include "mesh/mass_properties.hpp"
#include "mesh/shapes.hpp"
#include "mesh_test.hpp"

#include <nlohmann/json.hpp>

using namespace bem;

namespace {

double number(const nlohmann::json& value) {
  return std::stod(value.get<std::string>());
}

Vec3 vector3(const nlohmann::json& value) {
  return {number(value[0]), number(value[1]), number(value[2])};
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (double v : values) total += v;
  return total;
}

}  // namespace

TEST_CASE("mass, centre and inertia of the reference polyhedra") {
  const auto reference =
      nlohmann::json::parse(test::read_file(std::string(BEM_TEST_DATA) + "/reference/mass.json"));
  REQUIRE(reference["meshes"].size() == 3);
  for (const auto& entry : reference["meshes"]) {
    INFO(entry["name"]);
    TriangleMesh mesh;
    for (const auto& v : entry["vertices"]) mesh.vertices.push_back(vector3(v));
    for (const auto& f : entry["faces"]) mesh.triangles.push_back({f[0], f[1], f[2]});
    const MassProperties result = mass_properties(mesh, number(entry["rho"]));
    CHECK(std::abs(result.volume - number(entry["volume"])) < 1e-15);
    CHECK(std::abs(result.mass - number(entry["mass"])) < 1e-15);
    CHECK((result.centre - vector3(entry["com"])).norm() < 1e-15);
    for (int i = 0; i < 3; ++i) {
      const Vec3 row = vector3(entry["inertia_about_com"][i]);
      CHECK((result.inertia.row(i).transpose() - row).norm() < 1e-15);
    }
  }
}

TEST_CASE("mass properties follow a shift far from the origin") {
  TriangleMesh mesh = random_tetrahedron(5);
  const MassProperties near = mass_properties(mesh, 2.0);
  const Vec3 shift(1000, -2000, 500);
  for (Vec3& v : mesh.vertices) v += shift;
  const MassProperties far = mass_properties(mesh, 2.0);
  CHECK(far.volume == Approx(near.volume).epsilon(1e-10));
  CHECK((far.centre - shift - near.centre).norm() < 1e-10);
  CHECK((far.inertia - near.inertia).norm() < 1e-10 * near.inertia.norm());
}

TEST_CASE("vertex areas add up to the surface") {
  const TriangleMesh cube = box({1, 1, 1}, {1, 1, 1});
  const std::vector<double> areas = vertex_areas(cube);
  CHECK(sum(areas) == Approx(6.0).epsilon(1e-14));
  const std::vector<double> tetrahedron = vertex_areas(test::unit_tetrahedron());
  CHECK(tetrahedron[0] == Approx(0.5).epsilon(1e-14));  // three faces of area 1/2
  CHECK(tetrahedron[1] == Approx((1.0 + std::sqrt(0.75)) / 3.0).epsilon(1e-14));
}

TEST_CASE("volume weights sum to three volumes and match numerical integration") {
  const TriangleMesh mesh = random_tetrahedron(3);
  const Vec3 centre(0.2, 0.1, -0.3);
  const std::vector<double> weights = volume_weights(mesh, centre);
  const std::vector<Mat3> matrices = volume_centroid_weights(mesh, centre);
  CHECK(sum(weights) == Approx(3.0 * mass_properties(mesh, 1.0).volume).epsilon(1e-13));

  // Midpoints of the edges integrate polynomials of degree 2 exactly.
  std::vector<double> w(4, 0.0);
  std::vector<Mat3> m(4, Mat3::Zero());
  for (const Triangle& t : mesh.triangles) {
    for (int edge = 0; edge < 3; ++edge) {
      const int i = t[edge], j = t[(edge + 1) % 3];
      const Vec3 y = 0.5 * (mesh.vertices[i] + mesh.vertices[j]) - centre;
      for (int v : {i, j}) {
        w[v] += 0.5 * triangle_area(mesh, t) / 3.0 * y.dot(triangle_normal(mesh, t));
        m[v] += 0.5 * triangle_area(mesh, t) / 3.0 * y * triangle_normal(mesh, t).transpose();
      }
    }
  }
  for (int v = 0; v < 4; ++v) {
    CHECK(std::abs(weights[v] - w[v]) < 1e-15);
    CHECK((matrices[v] - m[v]).norm() < 1e-15);
    CHECK(std::abs(matrices[v].trace() - weights[v]) < 1e-15);
  }
}

TEST_CASE("centroid weights are the derivative of the volume centroid") {
  TriangleMesh mesh = star(1, 1.0);
  const MassProperties before = mass_properties(mesh, 1.0);
  const std::vector<Mat3> weights = volume_centroid_weights(mesh, before.centre);
  const double step = 1e-6;
  Vec3 predicted = Vec3::Zero();
  std::vector<Vec3> moves;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    moves.emplace_back(std::sin(3.0 * v), std::cos(5.0 * v), std::sin(7.0 * v + 1.0));
    predicted += weights[v] * moves[v] / before.volume;
  }
  TriangleMesh minus = mesh;
  for (std::size_t v = 0; v < moves.size(); ++v) {
    mesh.vertices[v] += step * moves[v];
    minus.vertices[v] -= step * moves[v];
  }
  const Vec3 measured =
      (mass_properties(mesh, 1.0).centre - mass_properties(minus, 1.0).centre) / (2.0 * step);
  CHECK(predicted.norm() > 0.01);
  CHECK((measured - predicted).norm() < 1e-8);
}
