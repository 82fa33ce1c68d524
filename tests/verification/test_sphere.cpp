// Sphere under sudden uniform pressure: modal series (docs/accuracy.md), compared at the surface.
#include "support/simulate.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

constexpr double kRadius = 0.5, kDensity = 1000, kPressure = 1000;

struct Sphere {
  double mu, nu;
  double lambda() const { return 2 * mu * nu / (1 - 2 * nu); }
  double c1() const { return std::sqrt((lambda() + 2 * mu) / kDensity); }
  double bulk() const { return lambda() + 2 * mu / 3; }
  double rest() const { return -kPressure * kRadius / (3 * bulk()); }
};

double j0(double x) {
  return std::sin(x) / x;
}
double j1(double x) {
  return std::sin(x) / (x * x) - std::cos(x) / x;
}
double j2(double x) {
  return 3 / x * j1(x) - j0(x);
}

/// Radial displacement of the surface from the first modes: roots of (lambda+2mu) x j0 = 4 mu j1.
class ModalSeries {
 public:
  explicit ModalSeries(const Sphere& s) : sphere_(s) {
    const auto f = [&s](double x) {
      return (s.lambda() + 2 * s.mu) * x * j0(x) - 4 * s.mu * j1(x);
    };
    for (double x = 0.5; roots_.size() < 400; x += 0.05)
      if (f(x) * f(x + 0.05) < 0) {
        double low = x, high = x + 0.05;
        for (int i = 0; i < 60; ++i) {
          const double middle = 0.5 * (low + high);
          (f(low) * f(middle) <= 0 ? high : low) = middle;
        }
        roots_.push_back(0.5 * (low + high));
      }
  }
  double operator()(double t) const {
    double u = sphere_.rest();
    for (double x : roots_) {
      const double w = sphere_.c1() * x / kRadius;
      const double shape = j1(x) * j1(x) / (j1(x) * j1(x) - j0(x) * j2(x));
      u += 2 * kPressure / (kDensity * kRadius * w * w) * shape * std::cos(w * t);
    }
    return u;
  }

 private:
  Sphere sphere_;
  std::vector<double> roots_;
};

/// rms error of the mean radial displacement over three traversals, relative to the static one.
double sphere_error(const char* scheme, const Sphere& s, int subdivisions, int steps) {
  // the sphere of equal volume, so that the polyhedron's error is not one of size
  TriangleMesh mesh = icosphere(subdivisions, kRadius);
  const double grow =
      std::cbrt(4 * kPi / 3 * std::pow(kRadius, 3) / mass_properties(mesh, 1).volume);
  for (Vec3& v : mesh.vertices) v *= grow;
  const Material m = material(kDensity, s.mu, s.nu);
  const BodyGeometry g = geometry_of(mesh, kDensity);
  const double end = 8 * kRadius / s.c1();
  const double dt = end / steps;
  MemorySource source;
  const PrecomputeOptions o = options_for(g, m, scheme, g.extent / (m.shear_speed() * dt));
  source.add("b", precompute(g, o));
  Scene scene = one_body_scene(o.discretisation.dt);
  TractionSpec load;
  load.load = kPressure;
  scene.bodies[0].tractions.push_back(load);
  Simulation simulation(scene, source);
  const ModalSeries exact(s);
  double sum = 0;
  for (int n = 0; n < steps; ++n) {
    simulation.step();
    const std::vector<Vec3> x = simulation.bodies()[0].positions();
    double mean = 0;
    for (std::size_t v = 0; v < x.size(); ++v)
      mean += (x[v].norm() - g.input.vertices[v].norm()) / static_cast<double>(x.size());
    sum += std::pow((mean - exact(simulation.time())) / s.rest(), 2) / steps;
  }
  std::printf("sphere %s, nu %.2f, %zu vertices, %d steps, n_max %d: rms %.4f\n", scheme, s.nu,
              g.nodes.vertices.size(), steps, o.discretisation.history_length, std::sqrt(sum));
  return std::sqrt(sum);
}

}  // namespace

TEST_CASE("the modal series has the known values") {
  // u_r(a,t)/u_static at t c1/a = 0.5 and 1.99
  const std::tuple<double, double, double, double> known[] = {{1e6, 0.30, 0.917510, 0.355846},
                                                              {3e5, 0.45, 1.076048, 0.054932},
                                                              {1e6, 0.00, 0.618664, 1.352221}};
  for (const auto& [mu, nu, early, late] : known) {
    const Sphere s{mu, nu};
    const ModalSeries u(s);
    CHECK(u(0.5 * kRadius / s.c1()) / s.rest() == Approx(early).margin(1e-3));
    CHECK(u(1.99 * kRadius / s.c1()) / s.rest() == Approx(late).margin(1e-3));
  }
}

TEST_CASE("sphere under pressure, three materials") {
  CHECK(sphere_error("radau2", {1e6, 0.30}, 2, 60) < 0.05);
  CHECK(sphere_error("radau2", {3e5, 0.45}, 2, 24) < 0.2);
  CHECK(sphere_error("radau2", {1e6, 0.00}, 2, 60) < 0.05);
}

TEST_CASE("sphere under pressure: every scheme, and convergence") {
  const Sphere s{1e6, 0.30};
  const double bdf1 = sphere_error("bdf1", s, 2, 60);
  const double theta = sphere_error("theta:0.75", s, 2, 60);
  const double bdf2 = sphere_error("bdf2", s, 2, 60);
  const double radau = sphere_error("radau2", s, 2, 60);
  const double coarse = sphere_error("radau2", s, 1, 30);
  CHECK(radau < 0.5 * bdf2);
  CHECK(bdf2 < bdf1);
  CHECK(theta < bdf1);
  CHECK(radau < 0.6 * coarse);
}
