// Bodies that rotate: stretched by the centrifugal force, deformed by the gyroscopic one when they
// tumble, and turned as Euler's equations say. Printed figures are quoted in
// docs/accuracy/momentum.md, "Rotating bodies".
#include "algebra/decompositions.hpp"
#include "base/symmetric_matrix.hpp"
#include "dynamics/rotation.hpp"
#include "support/simulate.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

/// One body that spins freely.
struct Spinning {
  Spinning(const TriangleMesh& mesh, const Material& m, const Vec3& omega, const char* scheme,
           double lam, double time_step)
      : geometry(geometry_of(mesh, m.density)) {
    const bool is_static = std::string(scheme) == "static";
    const PrecomputeOptions o =
        is_static ? quasistatic_options(geometry, m) : options_for(geometry, m, scheme, lam);
    source.add("b", precompute(geometry, o));
    scene = one_body_scene(is_static ? time_step : o.discretisation.dt);
    scene.bodies[0].angular_velocity = omega;
    simulation.emplace(scene, source);
  }
  const Body& body() const { return simulation->bodies()[0]; }
  Eigen::VectorXd displacement_after(int steps) {
    for (int n = 0; n < steps; ++n) simulation->step();
    return body().displacement();
  }

  BodyGeometry geometry;
  MemorySource source;
  Scene scene;
  std::optional<Simulation> simulation;
};

double relative(const Eigen::VectorXd& u, const Eigen::VectorXd& exact) {
  return (u - exact).norm() / exact.norm();
}

/// Without the rigid motion that is nearest to it: dynamic bodies are measured from the frame of
/// their momentum, static ones from that of their volume.
Eigen::VectorXd deformation(const BodyGeometry& g, const Eigen::VectorXd& u) {
  Eigen::MatrixXd rigid(u.size(), 6);
  rigid << translations(g.nodes), rotations(g.nodes);
  return u - rigid * least_squares(rigid, u);
}

template <class Field>
Eigen::VectorXd at_nodes(const BodyGeometry& g, const Field& field) {
  Eigen::VectorXd u(static_cast<Eigen::Index>(3 * g.nodes.vertices.size()));
  for (std::size_t i = 0; i < g.nodes.vertices.size(); ++i)
    u.segment<3>(static_cast<Eigen::Index>(3 * i)) = field(g.nodes.vertices[i]);
  return u;
}

/// A box with nu = 0 that spins with `w` about z: stretched along x and y like two bars, exactly.
Vec3 spinning_box(const Vec3& x, const Vec3& half, const Material& m, double w) {
  const double factor = m.density * w * w / (2 * 2 * m.shear_modulus);
  const auto along = [&](int i) {
    return factor * (half[i] * half[i] * x[i] - x[i] * x[i] * x[i] / 3);
  };
  return {along(0), along(1), 0};
}

/// A sphere that spins with `w` about z: the isotropic part of the centrifugal force moves points
/// radially, the rest is p grad phi + q r^2 grad phi + s x phi with phi = z^2 - (x^2 + y^2)/2.
class SpinningSphere {
 public:
  SpinningSphere(double radius, const Material& m, double w) {
    const double mu = m.shear_modulus, nu = m.poisson_ratio, a = radius;
    const double lambda = 2 * mu * nu / (1 - 2 * nu), force = m.density * w * w;
    cubic_ = -2.0 / 3 * force / (10 * (lambda + 2 * mu));
    linear_ = -cubic_ * a * a * (5 * lambda + 6 * mu) / (3 * lambda + 2 * mu);
    const double s_by_q = -(4 * lambda + 4 * mu) / (5 * lambda + 4 * mu);
    q_ = force / 3 / (mu * (10 + 2 * s_by_q) + (lambda + mu) * (4 + 5 * s_by_q));
    s_ = s_by_q * q_;
    p_ = -a * a * (4 * mu * q_ + mu * s_) / (2 * mu);
  }
  Vec3 operator()(const Vec3& x) const {
    const double r2 = x.squaredNorm(), phi = x[2] * x[2] - 0.5 * (x[0] * x[0] + x[1] * x[1]);
    const Vec3 gradient(-x[0], -x[1], 2 * x[2]);
    return (linear_ + cubic_ * r2) * x + (p_ + q_ * r2) * gradient + s_ * phi * x;
  }

 private:
  double linear_, cubic_, p_, q_, s_;
};

const Vec3 kBox(0.3, 0.2, 0.1);

}  // namespace

TEST_CASE("a spinning bar is stretched as the theory says") {
  const Material m = material(1000, 1e6, 0);
  const Vec3 size(1, 0.2, 0.2);
  std::vector<double> errors, ends;
  for (const int n : {1, 2, 4}) {
    Spinning bar(box(size, {5 * n, n, n}), m, Vec3(0, 0, 3), "static", 1, 1e-3);
    const auto exact = [&](const Vec3& x) { return spinning_box(x, 0.5 * size, m, 3); };
    const Eigen::VectorXd u = bar.displacement_after(1), theory = at_nodes(bar.geometry, exact);
    errors.push_back(relative(u, theory));
    ends.push_back(u.maxCoeff() / exact(0.5 * size)[0] - 1);
    std::printf("spinning bar, %d nodes: error %.1e, of the end %+.1e\n",
                static_cast<int>(bar.geometry.nodes.vertices.size()), errors.back(), ends.back());
  }
  CHECK(errors[2] < 8e-3);
  CHECK(errors[1] / errors[2] > 2.5);
}

TEST_CASE("a spinning sphere is flattened as the theory says") {
  for (const double nu : {0.0, 0.3, 0.49}) {
    const Material m = material(1000, 1e6, nu);
    std::vector<double> errors;
    for (const int level : {1, 2, 3}) {
      Spinning sphere(icosphere(level, 0.5), m, Vec3(0, 0, 3), "static", 1, 1e-3);
      const SpinningSphere exact(0.5, m, 3);
      errors.push_back(relative(sphere.displacement_after(1), at_nodes(sphere.geometry, exact)));
    }
    std::printf("spinning sphere, nu %.2f, 42, 162, 642 nodes: error %.1e %.1e %.1e\n", nu,
                errors[0], errors[1], errors[2]);
    INFO("nu " << nu);
    CHECK(errors[2] < 0.015);
    CHECK(errors[1] / errors[2] > 3);
  }
}

TEST_CASE("a dynamic body that spins comes to rest at the static stretch") {
  const Material m = material(1000, 1e6, 0.3);
  const Vec3 omega(0, 0, 3);
  const Eigen::VectorXd stretched =
      Spinning(box(kBox, {3, 2, 1}), m, omega, "static", 1, 1e-3).displacement_after(1);
  const std::pair<const char*, double> schemes[] = {
      {"radau2", 1.2}, {"radau3", 1.2}, {"bdf1", 0.5}, {"bdf2", 1.2}};
  for (const auto& [scheme, lam] : schemes) {
    Spinning body(box(kBox, {3, 2, 1}), m, omega, scheme, lam, 0);
    const double error = relative(body.displacement_after(1500), stretched);
    std::printf("spinning box, %s: off the static stretch by %.1e\n", scheme, error);
    INFO(scheme);
    CHECK(error < 1e-8);
  }
}

TEST_CASE("a stiff body that tumbles deforms as its inertia forces say") {
  const Material m = material(1000, 1e7, 0.3);
  Spinning body(box(kBox, {3, 2, 1}), m, Vec3(0.05, 5, 0.05), "radau2", 1.5, 0);
  const BodyModel at_rest = precompute(body.geometry, quasistatic_options(body.geometry, m));
  const ElasticSystem system(at_rest);
  const Eigen::MatrixXd columns =
      system.make_columns(at_rest.centrifugal, at_rest.initial_centrifugal).displacement[0].real();
  const int steps = static_cast<int>(std::lround(4.5 / body.scene.time_step));
  double size = 0, difference = 0, lowest = 1;
  for (int n = 0; n < steps; ++n) {
    const Eigen::VectorXd u = deformation(body.geometry, body.displacement_after(1));
    const RigidFrame& frame = body.body().frame();
    const Vec3 w = body.geometry.mass.inertia.inverse() *
                   (frame.rotation().transpose() * frame.angular_momentum());
    lowest = std::min(lowest, w[1]);
    if (n < steps / 4) continue;  // the sudden start has died away
    const Vector6 entries =
        symmetric_entries(w.squaredNorm() * Mat3::Identity() - w * w.transpose());
    const Eigen::VectorXd v = deformation(body.geometry, columns * entries);
    size = std::max(size, v.norm());
    difference = std::max(difference, (u - v).norm());
  }
  std::printf(
      "tumbling box: deformation differs from that of its inertia forces by %.1e, lowest turning "
      "%.1f rad/s\n",
      difference / size, lowest);
  CHECK(lowest < -2);
  CHECK(difference < 1e-3 * size);
}

TEST_CASE("an elastic body nutates with the frequency of a rigid one") {
  const Material m = material(1000, 1e6, 0.3);
  const Vec3 omega(0.5, 0, 6);
  Spinning top(box(Vec3(0.2, 0.2, 0.1), {2, 2, 1}), m, omega, "radau2", 2, 0);
  const Mat3& inertia = top.geometry.mass.inertia;
  const Vec3 momentum = inertia * omega;
  top.displacement_after(static_cast<int>(std::lround(2 / top.scene.time_step)));
  const double t = top.simulation->time(), rate = (1 - inertia(2, 2) / inertia(0, 0)) * omega[2];
  const Mat3 exact =
      rotation_exp(t / inertia(0, 0) * momentum) * rotation_exp(Vec3(0, 0, t * rate));
  const double error = (top.body().frame().rotation() - exact).norm() / std::sqrt(2);
  std::printf("nutation: %.1f turns of the axis, attitude error %.1e\n",
              t * momentum.norm() / inertia(0, 0) / (2 * kPi), error);
  CHECK(error < 1e-5);
}
