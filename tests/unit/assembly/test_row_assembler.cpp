#include "assembly/laplace_assembly.hpp"
#include "assembly/row_assembler.hpp"
#include "support/bodies.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

struct Lags {
  std::vector<Eigen::MatrixXd> h, g, d, q;  // by lane
  double residual = 0;
};

Lags assemble_all(const TriangleMesh& mesh, const Discretisation& d, bool fix) {
  const RowAssembler assembler(mesh, diameter(mesh.vertices), d);
  const int n = static_cast<int>(mesh.vertices.size());
  const int lanes = assembler.layout().count();
  Lags out;
  out.h.assign(lanes, Eigen::MatrixXd::Zero(3 * n, 3 * n));
  out.g = out.h;
  out.d.assign(lanes, Eigen::MatrixXd::Zero(3 * n, 3));
  out.q = out.d;
  RowAssembler::Workspace work;
  BlockRow<double> row;
  constexpr int kSymmetric[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
  for (int i = 0; i < n; ++i) {
    out.residual = std::max(out.residual, assembler.assemble(i, fix, work, row));
    for (int lane = 0; lane < lanes; ++lane)
      for (int e = 0; e < 9; ++e) {
        const int r = 3 * i + e / 3, c = e % 3;
        out.d[lane](r, c) = row.d[e * row.padded_lanes + lane];
        out.q[lane](r, c) = row.q[e * row.padded_lanes + lane];
        for (int j = 0; j < n; ++j) {
          out.h[lane](r, 3 * j + c) = row.h_block(j)[e * row.padded_lanes + lane];
          out.g[lane](r, 3 * j + c) = row.g_block(j)[kSymmetric[e] * row.padded_lanes + lane];
        }
      }
  }
  return out;
}

double relative(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("lag 0 equals the Laplace matrices at the eigenvalues of Delta(0)/dt") {
  const TriangleMesh mesh = centred(star(1, 1));
  for (const char* name : {"radau2", "theta:0.75", "bdf1"})
    for (double nu : {0.0, 0.3, 0.5}) {
      Discretisation d;
      d.material = material(1.3, 2.1, nu);
      d.scheme = Scheme::parse(name);
      d.dt = 0.4;
      d.history_length = 6;
      d.quadrature_tolerance = 1e-7;
      const Lags fast = assemble_all(mesh, d, false);
      int lane = 0;
      for (const InitialComponent& c : d.scheme.initial_components()) {
        // the same quadrature for both paths: the reference at the largest |s| of the scheme
        const LaplaceMatrices exact = laplace_matrices(mesh, d.material, c.eigenvalue / d.dt, 1e-9);
        INFO(name << ", nu " << nu);
        CHECK(relative(fast.h[lane], exact.h.real()) < 1e-6);
        CHECK(relative(fast.g[lane], exact.g.real()) < 1e-6);
        CHECK(relative(fast.d[lane], exact.d.real()) < 1e-6);
        CHECK(relative(fast.q[lane], exact.q.real()) < 1e-6);
        if (c.paired) {
          CHECK(relative(fast.h[lane + 1], exact.h.imag()) < 1e-6);
          CHECK(relative(fast.g[lane + 1], exact.g.imag()) < 1e-6);
        }
        lane += c.paired ? 2 : 1;
      }
    }
}

TEST_CASE("later lags equal the contour integral of the Laplace matrices") {
  const TriangleMesh mesh = centred(icosphere(1, 1));
  for (const char* name : {"bdf1", "bdf2"}) {
    Discretisation d;
    d.material = material(1.3, 2.1, 0.3);
    d.scheme = Scheme::parse(name);
    d.dt = 2.0 / (d.material.shear_speed() * 2.0);
    d.history_length = 16;
    const Lags fast = assemble_all(mesh, d, false);
    const int length = 2 * (d.history_length + 1);
    const double radius = std::pow(1e-8, 0.5 / length);
    const int checked[] = {1, 3, 5};
    std::vector<Eigen::MatrixXd> h(3, Eigen::MatrixXd::Zero(fast.h[0].rows(), fast.h[0].cols()));
    for (int l = 0; l < length; ++l) {
      const Complex zeta = std::polar(radius, 2 * kPi * l / length);
      const LaplaceMatrices m =
          laplace_matrices(mesh, d.material, d.scheme.delta(zeta)(0, 0) / d.dt, 1e-6);
      for (int c = 0; c < 3; ++c) h[c] += (m.h * std::pow(zeta, -checked[c])).real() / length;
    }
    for (int c = 0; c < 3; ++c) CHECK(relative(fast.h[checked[c]], h[c]) < 2e-4);
  }
}

TEST_CASE("the own-block fix makes rigid translation exact and changes little") {
  const TriangleMesh mesh = centred(star(1, 1));
  for (const char* name : {"radau2", "bdf2"}) {
    Discretisation d;
    d.material = material(1.3, 2.1, 0.3);
    d.scheme = Scheme::parse(name);
    d.dt = 0.3;
    d.history_length = default_history_length(
        d.scheme, diameter(mesh.vertices) / (d.material.shear_speed() * d.dt));
    d.quadrature_tolerance = 1e-7;
    const Lags fixed = assemble_all(mesh, d, true);
    CHECK(fixed.residual < 1e-5);
    CHECK(fixed.residual > 1e-12);
    // free of the identity that was imposed: rotations, only to the quadrature tolerance (M42)
    const InitialComponent& c = d.scheme.initial_components()[0];
    const Complex s = c.eigenvalue / d.dt;
    const auto lane0 = [&](const std::vector<Eigen::MatrixXd>& x) {
      Eigen::MatrixXcd m = x[0].cast<Complex>();
      if (c.paired) m += Complex(0, 1) * x[1].cast<Complex>();
      return m;
    };
    const Eigen::MatrixXcd t = lane0(fixed.h) * translations(mesh) + s * s * lane0(fixed.d);
    const Eigen::MatrixXcd r = lane0(fixed.h) * rotations(mesh) + s * s * lane0(fixed.q);
    CHECK(t.cwiseAbs().maxCoeff() < 1e-12);
    CHECK(r.cwiseAbs().maxCoeff() < 1e-5);
  }
}

TEST_CASE("rows in single precision agree with double precision to 1e-6 of the row") {
  const TriangleMesh mesh = centred(star(3, 1));
  Discretisation d;
  d.material = material(1.3, 2.1, 0.4);
  d.dt = 0.5;
  d.history_length = 7;
  const RowAssembler assembler(mesh, diameter(mesh.vertices), d);
  RowAssembler::Workspace work;
  BlockRow<double> exact;
  BlockRow<float> row;
  for (int vertex : {0, 100, 641}) {
    assembler.assemble(vertex, true, work, exact);
    assembler.assemble(vertex, true, work, row);
    double h = 0, g = 0, largest_g = 0;
    for (std::size_t j = 0; j < mesh.vertices.size(); ++j)
      for (int e = 0; e < 9; ++e)
        for (int lane = 0; lane < assembler.layout().count(); ++lane) {
          const int i = e * exact.padded_lanes + lane, k = e * row.padded_lanes + lane;
          h = std::max(h, std::abs(exact.h_block(j)[i] - double(row.h_block(j)[k])));
          if (e >= 6) continue;
          g = std::max(g, std::abs(exact.g_block(j)[i] - double(row.g_block(j)[k])));
          largest_g = std::max(largest_g, std::abs(exact.g_block(j)[i]));
        }
    CHECK(h < 1e-6);
    CHECK(h > 0);
    CHECK(g < 1e-6 * largest_g);
  }
}
