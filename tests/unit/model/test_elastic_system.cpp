#include "model/elastic_system.hpp"
#include "support/models.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

TEST_CASE("the rigid part of a displacement field recovers translation and rotation") {
  for (const TriangleMesh& mesh : {centred(star(2, 1)), centred(box(Vec3(2, 1, 0.3), {6, 3, 2}))}) {
    const Eigen::MatrixXd rigid = rigid_part(mesh);
    const Eigen::MatrixXd t = rigid * translations(mesh), r = rigid * rotations(mesh);
    CHECK((t.topRows(3) - Mat3::Identity()).norm() < 1e-12);
    CHECK(t.bottomRows(3).norm() < 1e-12);
    CHECK((r.bottomRows(3) - Mat3::Identity()).norm() < 1e-12);
    CHECK(r.topRows(3).norm() < 1e-12);
  }
}

TEST_CASE("a lag history weights, combines and forgets its values") {
  const Scheme radau = Scheme::radau2();
  LagHistory h(radau, 1, 3, 0.5);
  CHECK(h.is_zero(1));
  for (double value : {1.0, 2.0, 3.0, 4.0}) {
    Eigen::MatrixXd stages(1, 2);
    stages << value, 10 * value;
    h.push(stages);
  }
  CHECK(!h.is_zero(3));
  for (int k = 1; k <= 3; ++k)
    for (int m = 0; m < 3; ++m) {
      const StageVector& right = radau.lag_components()[m].right;
      const double value = 5 - k;
      CHECK(h.lag(k)(0, m) == Approx(right[0] * value + right[1] * 10 * value));
      CHECK(h.factor(k) == std::pow(0.5, k));
    }
}

TEST_CASE("solutions satisfy the boundary integral equation and carry no rigid motion") {
  const Material m = material(1000, 1e6, 0.3);
  for (const char* scheme : {"radau2", "radau3", "theta:0.5"}) {
    const BodyGeometry g = geometry_of(star(1, 0.4), m.density);
    const BodyModel model = precompute(g, options_for(g, m, scheme, 3));
    const ElasticSystem system(model);
    const auto n = static_cast<Eigen::Index>(3 * model.nodes());
    const Eigen::MatrixXd sums = Eigen::MatrixXd::Random(n, model.components());
    const SpectralState state = system.solve({sums})[0];
    const Eigen::MatrixXd u = system.displacement_stages(state);
    CHECK((system.projection().rigid() * u).norm() < 1e-10 * u.norm());
    // H_0 (u + B z) = rhs: the inverse applied to D_0 z is what the projection took away
    for (std::size_t i = 0; i < state.displacement.size(); ++i) {
      Eigen::MatrixXd stage_sums = Eigen::MatrixXd::Zero(n, system.scheme().stages());
      for (int c = 0; c < model.components(); ++c)
        stage_sums += sums.col(c) * system.scheme().lag_components()[c].left.transpose();
      const Eigen::VectorXcd load =
          stage_sums.cast<Complex>() * system.scheme().initial_components()[i].right -
          model.initial_body_force[i] * state.acceleration[i];
      const Eigen::VectorXcd v = system.solver(static_cast<int>(i)).solve(load);
      CHECK((v - state.displacement[i]).norm() < 1e-9 * v.norm());
    }
  }
}

TEST_CASE(
    "forces and torques accelerate the frame as the projection does, whatever a codec changes") {
  const Material m = material(1000, 1e6, 0.3);
  for (const char* scheme : {"radau2", "bdf2"}) {
    const BodyGeometry g = geometry_of(star(1, 0.4), m.density);
    PrecomputeOptions options = options_for(g, m, scheme, 3);
    options.discretisation.method = SpatialMethod::galerkin;
    const BodyModel model = precompute(g, options);
    const ElasticSystem system(model);
    const auto n = static_cast<Eigen::Index>(3 * model.nodes());
    const Eigen::MatrixXd rigid = rigid_motions(model.geometry.nodes.vertices);
    const FrameBalance balance(model);
    for (int i = 0; i < static_cast<int>(model.initial_body_force.size()); ++i) {
      const Eigen::MatrixXcd loads = Eigen::MatrixXd::Random(n, 2).cast<Complex>();
      Eigen::MatrixXcd u = system.solver(i).solve(loads);
      CHECK((balance.body_force(i).transpose() * u).norm() <
            1e-10 * balance.body_force(i).norm() * u.norm());
      u += balance.moved(i, loads);
      const Eigen::MatrixXcd removed = system.projection().project(i, u);
      const auto z = [&](const Eigen::MatrixXcd& displacement) -> Eigen::MatrixXcd {
        return balance.accelerations(i, balance.body_force(i).transpose() * displacement,
                                     balance.moments(loads));
      };
      CHECK((z(u) - removed).norm() < 1e-5 * removed.norm());  // the quadrature's row sums
      // an error of the solution counts with its inertia only
      CHECK((z(1.001 * u) - z(u)).norm() < 2e-3 * removed.norm());
    }
    // constant nodal tractions accelerate the body by the integrals of their hat functions
    const std::vector<double> areas = vertex_areas(model.geometry.nodes);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Vec3 expected = Vec3::Unit(j % 3) * areas[j / 3] / model.geometry.mass.mass;
      CHECK((model.traction_balance.col(j).head<3>() - expected).norm() < 1e-5 * expected.norm());
    }
  }
}
