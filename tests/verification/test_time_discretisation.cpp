// The error of the time discretisation alone: bodies that are solved exactly in space, by the
// scalar transfer function from their load to a displacement.
#include "support/step_response.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

/// A body under a unit step load: transfer function and exact response, both relative to the static
/// displacement.
struct Problem {
  std::function<Complex(Complex)> transfer;
  std::function<double(double)> exact;
  double end;  ///< errors are taken over 0 <= t <= end
};

constexpr double kSpeed = 30;

/// End of a fixed-free rod of length 1 and wave speed kSpeed under an end load: two periods.
Problem rod() {
  Problem p;
  p.transfer = [](Complex s) {
    const Complex z = s / kSpeed, echo = std::exp(-2.0 * z);
    return (1.0 - echo) / ((1.0 + echo) * z);  // tanh(z)/z
  };
  p.exact = [](double t) {
    const double phase = std::fmod(t * kSpeed, 4);  // triangle wave from 0 to 2
    return phase < 2 ? phase : 4 - phase;
  };
  p.end = 2 * 4 / kSpeed;
  return p;
}

double j0(double x) {
  return std::sin(x) / x;
}
double j1(double x) {
  return (j0(x) - std::cos(x)) / x;
}
double j2(double x) {
  return 3 / x * j1(x) - j0(x);
}

/// Frequencies of the radial modes times radius/c1: roots of x j0(x) = 4 kappa j1(x).
std::vector<double> radial_roots(double kappa, int count) {
  const auto f = [kappa](double x) { return x * j0(x) - 4 * kappa * j1(x); };
  std::vector<double> roots;
  for (double x = 0.5; static_cast<int>(roots.size()) < count; x += 0.05) {
    if (f(x) * f(x + 0.05) > 0) continue;
    double low = x, high = x + 0.05;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (f(low) * f(middle) <= 0 ? high : low) = middle;
    }
    roots.push_back(0.5 * (low + high));
  }
  return roots;
}

/// Surface of a sphere of radius 1 with pressure-wave speed 1 under a uniform pressure: eight
/// traversals of the radius.
Problem sphere(double nu) {
  const double kappa = (1 - 2 * nu) / (2 * (1 - nu));
  const double bulk = 3 - 4 * kappa;  // 3 K / (lambda + 2 mu)
  Problem p;
  p.transfer = [kappa, bulk](Complex s) {
    // u = A g(r s) with g = (x cosh x - sinh x)/x^2, everything times 2 exp(-x)
    const Complex echo = std::exp(-2.0 * s), sinh = 1.0 - echo, cosh = 1.0 + echo;
    const Complex g = (s * cosh - sinh) / (s * s);
    return bulk * g / (sinh - 4 * kappa * g);
  };
  p.exact = [kappa, bulk, roots = radial_roots(kappa, 2000)](double t) {
    double u = 1;
    for (double x : roots)
      u -= 2 * bulk / (x * x) * j1(x) * j1(x) / (j1(x) * j1(x) - j0(x) * j2(x)) * std::cos(x * t);
    return u;
  };
  p.end = 8;
  return p;
}

/// A load at t = 0 is counted in full, in part or not at all by multistep methods only.
double initial_load(const Scheme& scheme, double part) {
  return scheme.is_multistep() ? part : 0;
}

/// rms error over all steps from t = 0 to the end.
double error(const Problem& problem, const char* name, double dt, double part) {
  const Scheme scheme = Scheme::parse(name);
  const int steps = static_cast<int>(std::floor(problem.end / dt * (1 + 1e-12)));
  const std::vector<double> u =
      step_response(scheme, dt, steps, problem.transfer, initial_load(scheme, part));
  double sum = 0;
  for (int n = 0; n <= steps; ++n) sum += std::pow(u[n] - problem.exact(n * dt), 2);
  return std::sqrt(sum / (steps + 1));
}

const char* const kSchemes[] = {"bdf1", "theta:0.75", "bdf2", "radau2", "radau3"};
constexpr int kSchemeCount = 5;
using Errors = std::array<double, kSchemeCount>;

/// Errors of kSchemes.
Errors errors(const char* name, const Problem& problem, double dt, double part) {
  Errors e;
  std::printf("%-13s dt %.5f, initial load %.1f:", name, dt, part);
  for (int i = 0; i < kSchemeCount; ++i) {
    e[i] = error(problem, kSchemes[i], dt, part);
    std::printf("  %s %.4f", kSchemes[i], e[i]);
  }
  std::printf("\n");
  return e;
}

/// `known` was computed independently and has three decimals.
void check(const Errors& measured, const Errors& known) {
  for (int i = 0; i < kSchemeCount; ++i) CHECK(measured[i] == Approx(known[i]).margin(0.0006));
}

}  // namespace

TEST_CASE("time discretisation alone: the rod's end") {
  check(errors("rod", rod(), 0.004, 1), {0.276, 0.118, 0.072, 0.015, 0.0053});
  check(errors("rod", rod(), 0.002, 1), {0.176, 0.070, 0.042, 0.007, 0.0022});
  check(errors("rod", rod(), 0.0005, 1), {0.062, 0.024, 0.012, 0.001, 0.0004});
}

TEST_CASE("time discretisation alone: the sphere's surface") {
  check(errors("sphere nu 0.3", sphere(0.3), 8.0 / 60, 0), {0.416, 0.292, 0.307, 0.041, 0.0191});
  check(errors("sphere nu 0.3", sphere(0.3), 0.04, 0), {0.246, 0.108, 0.082, 0.010, 0.0040});
  check(errors("sphere nu 0", sphere(0), 8.0 / 60, 0), {0.410, 0.223, 0.198, 0.021, 0.0098});
}

TEST_CASE("time discretisation alone: how multistep methods count a sudden load") {
  // half of it at t = 0 is the trapezoidal rule
  for (const double dt : {0.004, 0.002, 0.0005}) {
    const Errors none = errors("rod", rod(), dt, 0), half = errors("rod", rod(), dt, 0.5);
    CHECK(half[2] < none[2]);
    CHECK(half[3] == none[3]);
    CHECK(none[3] < 0.15 * none[2]);
  }
}

TEST_CASE("time discretisation alone: order of convergence") {
  // (1 - exp(-t))^5, which sets in smoothly, is the response of this transfer function to the load
  const auto smooth = [](Complex s) {
    return 120.0 / ((s + 1.0) * (s + 2.0) * (s + 3.0) * (s + 4.0) * (s + 5.0));
  };
  const auto order = [&smooth](const char* name, double part) {
    const Scheme scheme = Scheme::parse(name);
    double e[2];
    for (int i = 0; i < 2; ++i) {
      const int steps = 80 << i;
      const double end = 4;
      const double u =
          step_response(scheme, end / steps, steps, smooth, initial_load(scheme, part))[steps];
      e[i] = std::abs(u - std::pow(1 - std::exp(-end), 5));
    }
    std::printf("%s, initial load %.1f: order %.2f\n", name, part, std::log2(e[0] / e[1]));
    return std::log2(e[0] / e[1]);
  };
  CHECK(order("bdf1", 0.5) == Approx(1).margin(0.1));
  CHECK(order("theta:0.75", 0.5) == Approx(1).margin(0.1));
  CHECK(order("bdf2", 0.5) == Approx(2).margin(0.1));
  CHECK(order("bdf2", 0) == Approx(1).margin(0.1));  // the load is half a step late
  CHECK(order("radau2", 0) == Approx(3).margin(0.1));
}
