// Static limit: what is left of a loaded body when its vibration has decayed. Printed figures are
// quoted in docs/accuracy/statics.md, "Static limit".
#include "dynamics/body_output.hpp"
#include "model/growth.hpp"
#include "support/lag_matrices.hpp"
#include "support/laplace_assembly.hpp"
#include "support/simulate.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

constexpr double kQuadrature = 1e-10;

struct Setup {
  TriangleMesh mesh;
  Material material;
  const char* scheme;
  double lam;
  double window = 1;
  int steps = 1000;
};

/// A model without history comes there in a few steps; `scheme` and `lam` do not matter.
Setup quasistatic(const TriangleMesh& mesh, const Material& m) {
  return {mesh, m, "static", 1, 1, 3};
}

PrecomputeOptions options_of(const Setup& s, const BodyGeometry& g) {
  const bool is_static = std::string(s.scheme) == "static";
  PrecomputeOptions o =
      is_static ? quasistatic_options(g, s.material) : options_for(g, s.material, s.scheme, s.lam);
  o.discretisation.quadrature_tolerance = kQuadrature;
  o.window = s.window;
  return o;
}

/// Displacements (3 per node, nodes as in the geometry) after the steps, from the frame (where the
/// body is also turned by the accumulated rounding of closed sums of pressures) or in a stationary
/// one from the start.
Eigen::VectorXd rest_displacement(const Setup& s, const BodyGeometry& g, const BodySpec& spec) {
  const PrecomputeOptions o = options_of(s, g);
  MemorySource source;
  source.add("b", precompute(g, o));
  const bool is_static = o.kind == ModelKind::quasistatic;
  Scene scene = one_body_scene(is_static ? 0.01 : o.discretisation.dt);
  const std::string name = scene.bodies[0].name;
  const FilePath archive = scene.bodies[0].archive;
  scene.bodies[0] = spec;
  scene.bodies[0].name = name;
  scene.bodies[0].archive = archive;
  Simulation simulation(scene, source);
  for (int n = 0; n < s.steps; ++n) simulation.step();
  const Body& body = simulation.bodies()[0];
  if (spec.frame == FrameMotion::moving) return body.displacement();
  const std::vector<Vec3> x = BodyOutput(body).positions();
  Eigen::VectorXd u(3 * static_cast<Eigen::Index>(g.nodes.vertices.size()));
  for (std::size_t v = 0; v < x.size(); ++v)
    u.segment<3>(3 * g.node_of_vertex[v]) = x[v] - g.input.vertices[v];
  return u;
}

/// u = A x for a free body under the tractions of the uniform stress sigma = C : A.
Eigen::VectorXd linear_field(const BodyGeometry& g, const Mat3& a) {
  Eigen::VectorXd u(3 * static_cast<Eigen::Index>(g.nodes.vertices.size()));
  for (std::size_t i = 0; i < g.nodes.vertices.size(); ++i)
    u.segment<3>(3 * static_cast<Eigen::Index>(i)) = a * g.nodes.vertices[i];
  return u;
}

double relative(const Eigen::VectorXd& u, const Eigen::VectorXd& exact) {
  return (u - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
}

TractionSpec pressure(double p) {
  TractionSpec t;
  t.load = p;
  return t;
}

TractionSpec end_load(double x, const Vec3& traction) {
  TractionSpec t;
  t.select = box_selection(Vec3(x - 1e-6, -1, -1), Vec3(x + 1e-6, 1, 1));
  t.load = traction;
  return t;
}

/// Elastostatic solution for nodes fixed where x is least and a constant traction where it is
/// largest, by the reference assembly at s = 0: H u - G t = load with nodal tractions t of the
/// fixed nodes. Collocation alone leaves forces out of balance by the discretisation error;
/// `balanced` demands balance and adds the uniform and linear body force that makes it possible.
Eigen::VectorXd held_solution(const BodyGeometry& g, const Material& m, const Vec3& traction,
                              bool balanced) {
  const LaplaceMatrices at_rest = laplace_matrices(g.nodes, m, 0.0, kQuadrature);
  double low = 0, high = 0;
  for (const Vec3& x : g.nodes.vertices) {
    low = std::min(low, x[0]);
    high = std::max(high, x[0]);
  }
  const std::array<Eigen::Vector3cd, 3> none{Eigen::Vector3cd::Zero(), Eigen::Vector3cd::Zero(),
                                             Eigen::Vector3cd::Zero()};
  std::vector<std::array<Eigen::Vector3cd, 3>> loads(g.nodes.triangles.size(), none);
  const auto n = static_cast<Eigen::Index>(3 * g.nodes.vertices.size());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 6);
  for (std::size_t t = 0; t < loads.size(); ++t) {
    const Triangle& triangle = g.nodes.triangles[t];
    const Vec3 centroid = triangle_centroid(g.nodes, triangle);
    if (centroid[0] < high - 1e-6) continue;
    loads[t].fill(traction.cast<Complex>());
    right.segment<3>(n) -= triangle_area(g.nodes, triangle) * traction;
    right.tail<3>() -= triangle_area(g.nodes, triangle) * centroid.cross(traction);
  }
  right.head(n) = laplace_corner_load(g.nodes, m, 0.0, kQuadrature, loads).real();
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 6, n + 6);
  system.topLeftCorner(n, n) = at_rest.h.real();
  std::vector<char> fixed(g.nodes.vertices.size(), 0);
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    if (g.nodes.vertices[i][0] > low + 1e-6) continue;
    fixed[i] = 1;
    const auto column = static_cast<Eigen::Index>(3 * i);
    system.block(0, column, n, 3) = -at_rest.g.real().middleCols<3>(column);
  }
  if (!balanced) {
    Eigen::VectorXd u = system.topLeftCorner(n, n).partialPivLu().solve(right.head(n));
    for (std::size_t i = 0; i < fixed.size(); ++i)
      if (fixed[i]) u.segment<3>(static_cast<Eigen::Index>(3 * i)).setZero();
    return u;
  }
  system.block(0, n, n, 3) = -at_rest.d.real();
  system.block(0, n + 3, n, 3) = -at_rest.q.real();
  for (const Triangle& t : g.nodes.triangles) {
    const double twelfth = triangle_area(g.nodes, t) / 12;
    const Vec3 sum = g.nodes.vertices[t[0]] + g.nodes.vertices[t[1]] + g.nodes.vertices[t[2]];
    for (const int v : t) {
      if (!fixed[v]) continue;
      system.block<3, 3>(n, 3 * v) += 4 * twelfth * Mat3::Identity();
      system.block<3, 3>(n + 3, 3 * v) += twelfth * cross_matrix(sum + g.nodes.vertices[v]);
    }
  }
  Eigen::VectorXd u = system.partialPivLu().solve(right).head(n);
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (fixed[i]) u.segment<3>(static_cast<Eigen::Index>(3 * i)).setZero();
  return u;
}

BodySpec held_spec(const Vec3& traction) {
  BodySpec spec;
  spec.frame = FrameMotion::stationary;  // small rotations, as in the elastostatic solution
  spec.fixed.push_back(box_selection(Vec3(-0.2 - 1e-6, -1, -1), Vec3(-0.2 + 1e-6, 1, 1)));
  spec.tractions.push_back(end_load(0.2, traction));
  return spec;
}

/// What is missing of H(0) u for u = x, relative, if the history ends after `length` steps and
/// nothing stands for the rest; `all`: the matrices of a longer one.
double missing_without_closure(const TriangleMesh& mesh, const Discretisation& d,
                               const LagMatrices& all, int length) {
  const LaneLayout layout(d.scheme, d.history_length);
  const auto n = static_cast<Eigen::Index>(3 * mesh.vertices.size());
  Eigen::VectorXd u(n);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    u.segment<3>(static_cast<Eigen::Index>(3 * i)) = mesh.vertices[i];
  Eigen::MatrixXd missing = Eigen::MatrixXd::Zero(n, d.scheme.stages());
  for (int k = length + 1; k <= d.history_length; ++k)
    for (int m = 0; m < layout.components; ++m) {
      const LagComponent& c = d.scheme.lag_components()[m];
      missing += c.right.sum() * (all.h[layout.lane(k, m)] * u) * c.left.transpose();
    }
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(n);
  const std::vector<double> factors = static_lane_factors(d.scheme, layout);
  for (std::size_t lane = 0; lane < factors.size(); ++lane)
    whole += factors[lane] * (all.h[lane] * u);
  return missing.cwiseAbs().maxCoeff() / whole.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("the last lag stands for all that the history leaves out") {
  const Material m = material(1000, 1e6, 0.3);
  const BodyGeometry g = geometry_of(icosphere(1, 0.5), m.density);
  for (const char* scheme : {"bdf1", "bdf2", "radau2"})
    for (const double lam : {3.5, 10.0}) {
      PrecomputeOptions o = options_for(g, m, scheme, lam);
      const int usual = o.discretisation.history_length, least = static_cast<int>(lam + 2);
      o.discretisation.history_length = 3 * usual;
      BodyModel model = precompute(g, o);
      const double all_lags = growth_factor(model).factor;
      const LagMatrices all = assemble_all(g.nodes, o.discretisation, true);
      for (const int length : {least, usual}) {
        const double missing = missing_without_closure(g.nodes, o.discretisation, all, length);
        model.discretisation.history_length = length;  // what comes after it is not looked at
        const double without = growth_factor(model).factor;
        PrecomputeOptions closed = o;
        closed.discretisation.history_length = length;
        const double with = growth_factor(precompute(g, closed)).factor;
        std::printf(
            "closure, %s, lam %.1f, %d lags: %.1e of the static limit missing without it; growth "
            "%.4f without, %.4f with it, %.4f with all lags\n",
            scheme, lam, length, missing, without, with, all_lags);
        INFO(scheme << ", lam " << lam << ", " << length << " lags");
        CHECK((length == usual ? missing < 4e-4 : missing > 1e-4));
        if (length == usual) CHECK(std::abs(with - all_lags) < 0.01);
      }
    }
}

TEST_CASE("free bodies under balanced loads come to the exact elastostatic deformation") {
  const Material m = material(1000, 1e6, 0.3);
  const double lambda = 2 * m.shear_modulus * 0.3 / 0.4, young = 2.6 * m.shear_modulus;
  const std::pair<const char*, double> schemes[] = {{"radau2", 1.2},     {"radau3", 1.2},
                                                    {"bdf1", 0.3},       {"bdf2", 1.2},
                                                    {"theta:0.75", 1.2}, {"static", 1}};
  for (const auto& [scheme, lam] : schemes) {
    const Setup pressed{star(1, 0.4), m, scheme, lam};
    const BodyGeometry g = geometry_of(pressed.mesh, m.density);
    BodySpec spec;
    spec.tractions.push_back(pressure(100));
    const double bulk = lambda + 2 * m.shear_modulus / 3;
    const double shrunk = relative(rest_displacement(pressed, g, spec),
                                   linear_field(g, -100 / (3 * bulk) * Mat3::Identity()));

    const Setup pulled{box(Vec3(0.4, 0.2, 0.2), {3, 2, 2}), m, scheme, lam};
    const BodyGeometry b = geometry_of(pulled.mesh, m.density);
    BodySpec ends;
    ends.tractions = {end_load(0.2, Vec3(100, 0, 0)), end_load(-0.2, Vec3(-100, 0, 0))};
    const Mat3 strain = 100 / young * Vec3(1, -0.3, -0.3).asDiagonal();
    const double longer = relative(rest_displacement(pulled, b, ends), linear_field(b, strain));
    std::printf("static %s: star under pressure %.1e, box pulled %.1e\n", scheme, shrunk, longer);
    INFO(scheme);
    CHECK(shrunk < 1e-9);
    CHECK(longer < 1e-9);
  }
}

TEST_CASE("held bodies come to the elastostatic solution of the same discretisation") {
  const Vec3 traction(4e4, -6e4, 2e4);  // linear: the size only lowers the rounding
  for (const double nu : {0.0, 0.3, 0.5}) {
    const Setup s{
        box(Vec3(0.4, 0.2, 0.2), {2, 1, 1}), material(1000, 1e6, nu), "bdf1", 0.3, 1, 1500};
    const BodyGeometry g = geometry_of(s.mesh, 1000);
    const BodySpec spec = held_spec(traction);
    const Eigen::VectorXd u = rest_displacement(s, g, spec);
    const double error = relative(u, held_solution(g, s.material, traction, true));
    std::printf("static, held, nu %.1f: %.1e, without balance of forces %.1e\n", nu, error,
                relative(u, held_solution(g, s.material, traction, false)));
    INFO("nu " << nu);
    CHECK(error < 1e-9);
  }
}

TEST_CASE("quasi-static held bodies are in equilibrium after the first step") {
  const Vec3 traction(4e5, -6e5, 2e5);
  for (const double nu : {0.0, 0.3, 0.5}) {
    Setup s = quasistatic(box(Vec3(0.4, 0.2, 0.2), {2, 1, 1}), material(1000, 1e6, nu));
    const BodyGeometry g = geometry_of(s.mesh, 1000);
    const Eigen::VectorXd exact = held_solution(g, s.material, traction, true);
    s.steps = 1;
    const double first = relative(rest_displacement(s, g, held_spec(traction)), exact);
    s.steps = 3;
    const double third = relative(rest_displacement(s, g, held_spec(traction)), exact);
    std::printf("quasi-static, held, nu %.1f: first step %.1e, third %.1e\n", nu, first, third);
    INFO("nu " << nu);
    CHECK(first < 1e-5);
    CHECK(third < 1e-9);
  }
}

TEST_CASE("a quasi-static body follows its handle and does not overshoot") {
  const TriangleMesh mesh = box(Vec3(0.4, 0.2, 0.2), {4, 2, 2});
  const BodyGeometry g = geometry_of(mesh, 1000);
  MemorySource source;
  source.add("b", precompute(g, options_of(quasistatic(mesh, material(1000, 1e4, 0.3)), g)));
  Scene scene = one_body_scene(0.01);
  scene.gravity = Vec3(0, -9.81, 0);
  scene.bodies[0].frame = FrameMotion::stationary;
  HandleSpec handle;
  handle.select = box_selection(Vec3(-0.2 - 1e-6, -1, -1), Vec3(-0.2 + 1e-6, 1, 1));
  handle.motion = {Keyframe{}, Keyframe{}};
  handle.motion[1].time = 0.05;
  handle.motion[1].translate = Vec3(0, 0, 0.1);
  scene.bodies[0].handles.push_back(handle);
  Simulation simulation(scene, source);
  std::vector<std::vector<Vec3>> positions;
  for (int n = 0; n < 8; ++n) {
    simulation.step();
    positions.push_back(BodyOutput(simulation.bodies()[0]).positions());
  }
  double sag = 0, apart = 0, drift = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    sag = std::max(sag, mesh.vertices[v][1] - positions[0][v][1]);
    apart = std::max(apart, (positions[4][v] - positions[2][v] - Vec3(0, 0, 0.04)).norm());
    drift = std::max(drift, (positions[7][v] - positions[4][v]).norm());
  }
  CHECK(sag > 0.01);  // of its own weight
  CHECK(apart < 1e-6);
  CHECK(drift < 1e-6);
}

TEST_CASE("free quasi-static bodies fall and spin like rigid ones, or stay in a stationary frame") {
  const TriangleMesh mesh = box(Vec3(0.3, 0.2, 0.1), {3, 2, 1});
  const BodyGeometry g = geometry_of(mesh, 1000);
  MemorySource source;
  source.add("b", precompute(g, options_of(quasistatic(mesh, material(1000, 1e4, 0.3)), g)));
  Scene scene = one_body_scene(0.01);
  scene.gravity = Vec3(0, -9.81, 0);
  scene.bodies[0].velocity = Vec3(1, 0, 0);
  Simulation falling(scene, source);
  scene.bodies[0].frame = FrameMotion::stationary;
  Simulation still(scene, source);
  for (int n = 0; n < 20; ++n) {
    falling.step();
    still.step();
  }
  const Vec3 way = BodyOutput(falling.bodies()[0]).positions()[0] - mesh.vertices[0];
  CHECK((way - Vec3(0.2, -0.5 * 9.81 * 0.04, 0)).norm() < 1e-12);
  CHECK((BodyOutput(still.bodies()[0]).positions()[0] - mesh.vertices[0]).norm() < 1e-12);
}

TEST_CASE("double nodes at the edges of a held face make uniform stress exact") {
  const Material m = material(1000, 1e6, 0);
  BodyGeometry g = geometry_of(box(Vec3(0.4, 0.2, 0.2), {4, 2, 2}), m.density);
  BodySpec spec = held_spec(Vec3(100, 0, 0));
  Eigen::VectorXd exact = linear_field(g, 100 / (2 * m.shear_modulus) * Vec3(1, 0, 0).asDiagonal());
  for (Eigen::Index i = 0; i < exact.size(); i += 3) exact[i] += 100 / (2 * m.shear_modulus) * 0.2;
  double errors[2];
  for (const bool corners : {false, true}) {
    if (corners) g.corner_angle_deg = 40;
    errors[corners] = relative(rest_displacement(quasistatic(g.nodes, m), g, spec), exact);
  }
  std::printf("rod pulled, held at one face: %.1e, with double nodes %.1e\n", errors[0], errors[1]);
  CHECK(errors[0] > 1e-3);
  CHECK(errors[1] < 1e-8);
}

TEST_CASE("a window changes the static limit little") {
  const Material m = material(1000, 1e6, 0.3);
  const Mat3 strain = -100 / (3 * (1.5e6 + 2e6 / 3)) * Mat3::Identity();
  const TriangleMesh ball = icosphere(1, 0.4), bar = box(Vec3(0.4, 0.2, 0.2), {3, 2, 2});
  const BodyGeometry g = geometry_of(ball, m.density), b = geometry_of(bar, m.density);
  const Vec3 traction(0, 1e5, 0);
  BodySpec spec;
  spec.tractions.push_back(pressure(100));
  const Eigen::VectorXd exact = held_solution(b, m, traction, true);
  // a spring of stiffness rho w^2 per volume, w = (1-q)/dt: second order in 1-q
  const std::tuple<const char*, double, double, double> limits[] = {
      {"radau2", 0.99, 1.5e-5, 0.003}, {"radau2", 0.98, 6e-5, 0.01}, {"radau2", 0.96, 2.4e-4, 0.04},
      {"bdf1", 0.99, 1.5e-5, 0.003},   {"bdf1", 0.98, 6e-5, 0.01},   {"bdf1", 0.96, 2.4e-4, 0.04}};
  for (const auto& [scheme, q, free_limit, held_limit] : limits) {
    const double free = relative(rest_displacement({ball, m, scheme, 3.5, q, 3000}, g, spec),
                                 linear_field(g, strain));
    const double held =
        relative(rest_displacement({bar, m, scheme, 3.5, q, 4000}, b, held_spec(traction)), exact);
    std::printf("static, %s, lam 3.5, window %.2f: free sphere %.1e, held bar %.1e\n", scheme, q,
                free, held);
    INFO(scheme << ", window " << q);
    CHECK(free < free_limit);
    CHECK(held < held_limit);
  }
}
