// Sphere under sudden uniform pressure: modal series (docs/accuracy/exact-solutions.md), compared
// at the surface.
#include "dynamics/body_output.hpp"
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

/// rms error of the mean radial displacement over eight radii / c1, relative to the static one.
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
  PrecomputeOptions o = options_for(g, m, scheme, g.extent / (m.shear_speed() * dt));
  if (subdivisions > 2) o.codec = CodecOptions();  // 7 GB instead of 13
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
    const std::vector<Vec3> x = BodyOutput(simulation.bodies()[0]).positions();
    double mean = 0;
    for (std::size_t v = 0; v < x.size(); ++v)
      mean += (x[v].norm() - g.input.vertices[v].norm()) / static_cast<double>(x.size());
    sum += std::pow((mean - exact(simulation.time())) / s.rest(), 2) / steps;
  }
  std::printf("sphere %s, nu %.2f, %zu vertices, %d steps, n_max %d: rms %.4f\n", scheme, s.nu,
              g.nodes.vertices.size(), steps, o.discretisation.history_length, std::sqrt(sum));
  return std::sqrt(sum);
}

const Sphere kRubber{1e6, 0.30}, kSoftRubber{3e5, 0.45}, kCork{1e6, 0};

/// Against 1.1 times the errors that were measured for bdf1, theta:0.75, bdf2 and radau2.
void check_schemes(const Sphere& s, int subdivisions, int steps,
                   const std::array<double, 4>& measured) {
  const char* schemes[] = {"bdf1", "theta:0.75", "bdf2", "radau2"};
  for (int i = 0; i < 4; ++i) {
    INFO(schemes[i] << ", nu " << s.nu);
    CHECK(sphere_error(schemes[i], s, subdivisions, steps) < 1.1 * measured[i]);
  }
}

}  // namespace

TEST_CASE("the modal series has the known values") {
  // u_r(a,t)/u_static, by t c1/a
  const double times[] = {0.13, 0.5, 0.9, 1.45, 1.99, 2.3, 3.1};
  const std::pair<Sphere, std::array<double, 7>> known[] = {
      {kRubber, {0.242976, 0.917510, 1.491308, 1.608270, 0.355846, 0.301200, 1.225881}},
      {kSoftRubber, {0.327977, 1.076048, 1.506755, 1.302635, 0.054932, 0.579311, 1.550496}},
      {kCork, {0.138425, 0.618664, 1.227794, 1.872883, 1.352221, 0.933288, 0.116933}}};
  for (const auto& [sphere, values] : known) {
    const ModalSeries u(sphere);
    for (std::size_t i = 0; i < values.size(); ++i)
      CHECK(std::abs(u(times[i] * kRadius / sphere.c1()) / sphere.rest() - values[i]) < 2e-5);
  }
}

TEST_CASE("sphere under pressure: every scheme, three materials") {
  check_schemes(kRubber, 1, 30, {0.479, 0.468, 0.543, 0.109});
  check_schemes(kSoftRubber, 1, 30, {0.444, 0.479, 0.595, 0.359});
  check_schemes(kCork, 1, 30, {0.509, 0.409, 0.439, 0.069});
}

TEST_CASE("sphere under pressure: twice the resolution") {
  CHECK(sphere_error("radau2", kRubber, 2, 60) < 1.1 * 0.0456);
}

TEST_CASE("sphere under pressure on a finer mesh: every scheme, three materials", "[.][long]") {
  check_schemes(kRubber, 2, 60, {0.421, 0.298, 0.307, 0.0456});
  check_schemes(kSoftRubber, 2, 60, {0.404, 0.316, 0.346, 0.0653});
  check_schemes(kCork, 2, 60, {0.415, 0.226, 0.190, 0.0309});
}

TEST_CASE("sphere under pressure: convergence", "[.][long]") {
  const double errors[] = {sphere_error("radau2", kRubber, 1, 30),
                           sphere_error("radau2", kRubber, 2, 60),
                           sphere_error("radau2", kRubber, 3, 120)};
  CHECK(errors[1] < 0.5 * errors[0]);
  CHECK(errors[2] < 0.6 * errors[1]);
}
