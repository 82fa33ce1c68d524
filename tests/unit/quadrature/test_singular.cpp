#include "quadrature/singular.hpp"
#include "quadrature/triangle_rules.hpp"
#include "support/collocation_kernels.hpp"
#include "support/reference.hpp"

#include <catch2/catch.hpp>

using namespace bem_test;
using bem::Complex;

namespace {

struct Medium {
  double mu, c2, kappa;
  Complex s;
};

Medium medium_of(const json& e) {
  Medium m;
  const double nu = number(e["nu"]);
  m.mu = number(e["mu"]);
  m.c2 = std::sqrt(m.mu / number(e["rho"]));
  m.kappa = (1 - 2 * nu) / (2 * (1 - nu));
  m.s = complex(e["s"]);
  return m;
}

struct Integrals {
  Eigen::Matrix3cd u[3], p[3], d, l;
  Integrals() : d(Eigen::Matrix3cd::Zero()), l(d) {
    for (auto* m : {u, p})
      for (int a = 0; a < 3; ++a) m[a].setZero();
  }
};

/// Adds one quadrature point; with `dynamic` the static part of p* is left out.
void add_point(const Medium& m, const bem::Vec3& x, const bem::Vec3& y, const bem::Vec3& n,
               const double* shape, double weight, bool dynamic, Integrals& sum) {
  const auto g = bem::pair_geometry(x, y, n);
  auto v = bem::radial_values(m.s * g.r / m.c2, m.kappa);
  const auto rest = bem::static_radial_values(m.kappa);
  const Eigen::Matrix3cd u = bem::displacement_kernel(g, v, m.mu);
  sum.d += weight * bem::translation_kernel(g, v, m.c2);
  sum.l += weight * bem::rotation_kernel(g, v, m.c2);
  if (dynamic)
    for (int f : {bem::kRadialP, bem::kRadialQ, bem::kRadialS}) v[f] -= rest[f];
  const Eigen::Matrix3cd p = bem::traction_kernel(g, v);
  for (int a = 0; a < 3; ++a) {
    sum.u[a] += weight * shape[a] * u;
    sum.p[a] += weight * shape[a] * p;
  }
}

/// Uniform subdivision with the 33-point rule: an independent, slow reference for outside points.
void integrate_regular(const Medium& m, const bem::Vec3& x, const bem::Vec3 corner[3], int depth,
                       Integrals& sum) {
  const bem::Vec3 doubled = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const double area = 0.5 * doubled.norm();
  const bem::Vec3 n = doubled.normalized();
  const int cells = 1 << depth;
  const auto cell = [&](double i0, double j0, double i1, double j1, double i2, double j2) {
    for (int q = 0; q < bem::triangle_rules().back().size; ++q) {
      const bem::TrianglePoint& b = bem::triangle_rules().back().points[q];
      const double s =
          (b.barycentric[0] * i0 + b.barycentric[1] * i1 + b.barycentric[2] * i2) / cells;
      const double t =
          (b.barycentric[0] * j0 + b.barycentric[1] * j1 + b.barycentric[2] * j2) / cells;
      const double shape[3] = {1 - s - t, s, t};
      const bem::Vec3 y = shape[0] * corner[0] + shape[1] * corner[1] + shape[2] * corner[2];
      add_point(m, x, y, n, shape, b.weight * area / (cells * cells), false, sum);
    }
  };
  for (int i = 0; i < cells; ++i)
    for (int j = 0; i + j < cells; ++j) {
      cell(i, j, i + 1, j, i, j + 1);
      if (i + j + 1 < cells) cell(i + 1, j, i + 1, j + 1, i, j + 1);
    }
}

double relative(const Eigen::Matrix3cd& value, const json& exact) {
  const Eigen::Matrix3cd e = matrix3(exact);
  return e.norm() == 0 ? value.norm() : (value - e).norm() / e.norm();
}

}  // namespace

TEST_CASE("integrals over triangles agree with the high-precision reference") {
  const json data = load_reference("triangle_integrals.json");
  double regular = 0, singular = 0;
  int count = 0;
  for (const json& e : data["integrals"]) {
    ++count;
    const Medium m = medium_of(e);
    const bem::Vec3 corner[3] = {vec3(e["tri"][0]), vec3(e["tri"][1]), vec3(e["tri"][2])};
    Integrals sum;
    if (e["kind"] == "regular") {
      integrate_regular(m, vec3(e["x"]), corner, 3, sum);
      for (int a = 0; a < 3; ++a)
        regular = std::max({regular, relative(sum.u[a], e["u"][a]), relative(sum.p[a], e["p"][a])});
      regular = std::max({regular, relative(sum.d, e["d"][0]), relative(sum.l, e["l"][0])});
    } else {
      const bem::VertexTriangle t(corner[0], corner[1], corner[2]);
      std::vector<bem::VertexTriangle::Point> points;
      t.polar_points(30, 20, points);
      for (const auto& p : points)
        add_point(m, corner[0], p.y, t.normal(), p.shape, p.weight, true, sum);
      for (int a = 0; a < 3; ++a) {
        singular = std::max(singular, relative(sum.u[a], e["u"][a]));
        if (std::abs(m.s) > 0) singular = std::max(singular, relative(sum.p[a], e["dp"][a]));
        const bem::Mat3 rest =
            a == 0 ? t.static_traction_own(m.kappa) : t.static_traction(a, m.kappa);
        singular = std::max(singular, relative(rest.cast<Complex>(), e["pstat"][a]));
      }
      singular = std::max({singular, relative(sum.d, e["d"][0]), relative(sum.l, e["l"][0])});
    }
  }
  CHECK(count == 36);
  CHECK(regular < 1e-13);
  CHECK(singular < 5e-15);
}

TEST_CASE("the default numbers of polar points reach their tolerance") {
  // u* over triangles with growing angles at x, against many points
  const Medium m{1.7, 1.1, 0.25, Complex(0.5, 0.6)};
  for (double degrees : {6.0, 60.0, 90.0, 120.0, 165.0}) {
    const double angle = degrees * bem::kPi / 180;
    const bem::Vec3 x(0, 0, 0), b(1, 0, 0), c(std::cos(angle), std::sin(angle), 0);
    const bem::VertexTriangle t(x, b, c);
    std::vector<bem::VertexTriangle::Point> points;
    const auto integrate = [&](int angular, int radial) {
      Integrals sum;
      t.polar_points(angular, radial, points);
      for (const auto& p : points) add_point(m, x, p.y, t.normal(), p.shape, p.weight, true, sum);
      return sum;
    };
    const Integrals exact = integrate(60, 30);
    for (double tolerance : {1e-4, 1e-6, 1e-8}) {
      const auto order = bem::polar_order(tolerance, t.angle(), std::abs(m.s) / m.c2);
      const Integrals sum = integrate(order.angular, order.radial);
      INFO("angle " << degrees << ", tolerance " << tolerance);
      for (int a = 0; a < 3; ++a) {
        CHECK((sum.u[a] - exact.u[a]).norm() < tolerance * exact.u[a].norm());
        CHECK((sum.p[a] - exact.p[a]).norm() < tolerance * exact.p[a].norm());
      }
      CHECK((sum.d - exact.d).norm() < tolerance * exact.d.norm());
    }
  }
}
