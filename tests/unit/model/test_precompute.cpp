#include "base/error.hpp"
#include "base/parallel.hpp"
#include "compress/complex_product.hpp"
#include "model/elastic_system.hpp"
#include "model/memory_estimate.hpp"
#include "model/nodal_tractions.hpp"
#include "model/precompute.hpp"
#include "support/laplace_assembly.hpp"
#include "support/models.hpp"

#include <cmath>
#include <numeric>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

TEST_CASE("the stored inverse and traction response belong to H_0 and G_0") {
  const Material m = material(1000, 1e6, 0.4);
  const BodyGeometry g = geometry_of(star(1, 0.4), m.density);
  for (const char* scheme : {"radau2", "radau3", "bdf2"}) {
    PrecomputeOptions o = options_for(g, m, scheme, 3);
    o.discretisation.quadrature_tolerance = 1e-8;
    const BodyModel model = precompute(g, o);
    const Complex s =
        o.discretisation.scheme.initial_components()[0].eigenvalue / o.discretisation.dt;
    const LaplaceMatrices exact = laplace_matrices(g.nodes, m, s, 1e-9);
    const ElasticSystem system(model);
    const Eigen::MatrixXcd h = exact.h;
    const Eigen::MatrixXcd product = system.solver(0).solve(h);
    CHECK((product - Eigen::MatrixXcd::Identity(h.rows(), h.cols())).cwiseAbs().maxCoeff() < 1e-5);
    const TractionData t = extract_tractions(model, {0, 7, 15});
    std::vector<int> rows(h.rows());
    std::iota(rows.begin(), rows.end(), 0);
    const Eigen::VectorXcd response = complex_block(*t.initial[0], rows, {22});
    CHECK((h * response - exact.g.col(22)).norm() < 1e-5 * exact.g.col(22).norm());
    CHECK(model.report.condition > 1);
    CHECK(model.report.condition < 1e5);
    CHECK(model.report.rotation_residual < 1e-5);
  }
}

TEST_CASE("precomputation is bit-identical for any number of threads") {
  const Material m = material(1000, 1e6, 0.4);
  const BodyGeometry g = geometry_of(star(1, 0.4), m.density);
  PrecomputeOptions o = options_for(g, m, "radau2", 3);
  o.codec = CodecOptions();
  std::vector<Eigen::MatrixXd> inverses, lags;
  for (int threads : {1, 2, 3}) {
    set_thread_count(threads);
    const BodyModel model = precompute(g, o);
    inverses.push_back(full_matrix(*model.inverse[0], 0));
    lags.push_back(full_matrix(*model.h, model.h->count() - 1));
  }
  CHECK(inverses[0] == inverses[1]);
  CHECK(inverses[0] == inverses[2]);
  CHECK(lags[0] == lags[1]);
  CHECK(lags[0] == lags[2]);
}

TEST_CASE("the automatic window brings the growth of an unstable body down to one") {
  // a coarse beam shows the weak negative damping of collocation
  const Material m = material(1000, 1e6, 0.3);
  const BodyGeometry g = geometry_of(box(Vec3(1, 0.2, 0.2), {8, 2, 2}), m.density);
  PrecomputeOptions o = options_for(g, m, "radau2", 3.5);
  o.measure_growth = true;
  o.window = 0;
  const BodyModel model = precompute(g, o);
  CHECK(model.report.growth > 1.0005);
  CHECK(model.report.growth < 1.02);
  CHECK(model.window < 1);
  CHECK(model.window * model.report.growth <= 1);
  CHECK(model.window * model.report.growth > 1 - 1e-5);
}

TEST_CASE("an automatic window that would leave nothing is refused") {
  // sharp edges, nu = 0.5 and a step in which a shear wave goes a third of an edge
  const Material m = material(1000, 1e6, 0.5);
  const BodyGeometry g = geometry_of(box(Vec3(1, 1, 1), {3, 3, 3}), m.density);
  PrecomputeOptions o = options_for(g, m, "radau2", 12.5);
  o.measure_growth = true;
  o.window = 0;
  try {
    precompute(g, o);
    FAIL("no error");
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::numerical);
    CHECK(std::string(e.what()).find("larger --dt") != std::string::npos);
  }
  o.window = 0.5;  // who insists gets it
  CHECK(precompute(g, o).window == 0.5);
  o.discretisation.scheme = Scheme::parse("bdf1");
  o.window = 0;
  CHECK(precompute(g, o).report.growth < 1);
}

TEST_CASE("the memory estimate counts the stored matrices") {
  const Material m = material(1000, 1e6, 0.4);
  const BodyGeometry g = geometry_of(icosphere(3, 1), m.density);
  PrecomputeOptions o = options_for(g, m, "radau2", 3);
  const auto stored = [](const BodyModel& model) {
    double bytes = static_cast<double>(model.h->bytes() + (model.g ? model.g->bytes() : 0));
    for (const auto* families :
         {&model.inverse, &model.traction_response, &model.initial_h, &model.initial_g})
      for (const auto& family : *families) bytes += static_cast<double>(family->bytes());
    return bytes;
  };
  o.codec = CodecOptions();
  o.discretisation.history_length = 6;
  // radau2: 18 lag matrices and one complex initial one, for H and G, in 4-byte entries
  const double unknowns = 3 * 642;
  const double dense = stored_bytes(g, o);
  CHECK(dense == Approx(unknowns * unknowns * 4 * 2 * 20).epsilon(0.02));
  CHECK(peak_bytes(g, o, dense) > dense);
  const BodyGeometry tiny = geometry_of(icosphere(0, 1), m.density);
  CHECK(peak_bytes(tiny, o, stored_bytes(tiny, o)) == Approx(4.5e7).epsilon(0.1));  // the program
  o.codec = CodecOptions(codec_named("lowrank"));
  const std::pair<Loads, InverseKind> variants[] = {{Loads::all, InverseKind::iterative},
                                                    {Loads::none, InverseKind::dense}};
  for (const auto& [loads, inverse] : variants) {
    o.loads = loads;
    o.inverse = inverse;
    const double bytes = stored_bytes(g, o);
    CHECK(bytes == Approx(stored(precompute(g, o))).epsilon(0.4));
    CHECK(peak_bytes(g, o, bytes) > bytes);
    CHECK(peak_bytes(g, o, 0) < peak_bytes(g, o, bytes));
  }
}

TEST_CASE("codecs are more exact where a body of the Galerkin method is thin or graded") {
  const auto tolerance = [](const TriangleMesh& mesh, SpatialMethod method) {
    return codec_of_body(geometry_of(mesh, 1000), method, CodecOptions(codec_named("lowrank")))
        .tolerance;
  };
  const TriangleMesh cube = box({1, 1, 1}, {2, 2, 2}), plate = box({1, 1, 0.02}, {5, 5, 1});
  const double thin = 0.02 / (0.2 * std::sqrt(2.0)) / 0.3;
  CHECK(tolerance(cube, SpatialMethod::galerkin) == 1e-4);
  CHECK(tolerance(plate, SpatialMethod::galerkin) == Approx(1e-4 * thin));
  CHECK(tolerance(plate, SpatialMethod::collocation) == 1e-4);
  TriangleMesh graded = box({1, 1, 1}, {6, 6, 6});
  for (Vec3& v : graded.vertices)  // small cells in the middle of its faces
    for (double& x : v) x = 16 * std::pow(x, 5);
  CHECK(tolerance(graded, SpatialMethod::galerkin) < 0.5e-4);
}
