#include "assembly/edge_reconstruction.hpp"
#include "mesh/grid_shapes.hpp"
#include "mesh/shapes.hpp"
#include "support/bodies.hpp"
#include "support/reference.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

/// max_e sum_j |rho_ej|: how far bubbles may exceed the values that they follow from.
double largest_row_sum(const TriangleMesh& mesh) {
  const EdgeReconstruction reconstruction(mesh);
  const auto& rho = reconstruction.coefficients();
  return (rho.cwiseAbs() * Eigen::VectorXd::Ones(rho.cols())).maxCoeff();
}

}  // namespace

TEST_CASE("coefficients of edges agree with the high-precision reference") {
  const json data = load_reference("discretisation.json")["edge_reconstruction"];
  TriangleMesh mesh;
  for (const json& v : data["vertices"]) mesh.vertices.push_back(vec3(v));
  for (const json& t : data["triangles"]) mesh.triangles.push_back({t[0], t[1], t[2]});
  const EdgeReconstruction reconstruction(mesh);
  for (const json& row : data["rows"]) {
    int a = row["edge"][0], b = row["edge"][1];
    if (a > b) std::swap(a, b);
    const auto& edges = reconstruction.edges().vertices;
    const auto e = std::find(edges.begin(), edges.end(), std::array<int, 2>{a, b}) - edges.begin();
    REQUIRE(e < static_cast<std::ptrdiff_t>(edges.size()));
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(static_cast<int>(mesh.vertices.size()));
    for (const auto& [vertex, value] : row["rho_recommended"].items())
      expected[std::stoi(vertex)] = number(value);
    const Eigen::VectorXd found = Eigen::MatrixXd(reconstruction.coefficients()).row(e);
    CHECK((found - expected).cwiseAbs().maxCoeff() < 1e-14);
  }
}

TEST_CASE("linear fields have no bubbles on any mesh") {
  for (const TriangleMesh& mesh :
       {centred(icosphere(1, 1)), centred(star(1, 1)), centred(box(Vec3(1, 0.2, 0.2), {10, 2, 2})),
        centred(random_tetrahedron(7)), centred(notched_cube(1, 2))}) {
    const EdgeReconstruction reconstruction(mesh);
    Eigen::MatrixXd fields(mesh.vertices.size(), 4);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      fields.row(static_cast<Eigen::Index>(i)) << 1, mesh.vertices[i].transpose();
    CHECK((reconstruction.coefficients() * fields).cwiseAbs().maxCoeff() < 1e-13);
    std::printf("largest row sum of the reconstruction: %.2f\n", largest_row_sum(mesh));
  }
  const TriangleMesh beam = centred(box(Vec3(1, 0.2, 0.2), {10, 2, 2}));
  CHECK(largest_row_sum(beam) == Approx(1.10).margin(0.01));
  CHECK(largest_row_sum(centred(icosphere(1, 1))) == Approx(0.77).margin(0.01));
}

TEST_CASE("basis functions of a triangle add up to one") {
  const TriangleMesh mesh = centred(star(1, 1));
  const EdgeReconstruction reconstruction(mesh);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const TriangleBasis basis = triangle_basis(mesh, reconstruction, t);
    std::array<double, 6> sum{};
    for (const auto& w : basis.weights)
      for (int i = 0; i < 6; ++i) sum[i] += w[i];
    for (int i = 0; i < 6; ++i) CHECK(sum[i] == Approx(i < 3 ? 1 : 0).margin(1e-13));
  }
}
