#include "algebra/decompositions.hpp"
#include "support/bodies.hpp"
#include "support/lag_matrices.hpp"
#include "support/laplace_assembly.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

double relative(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

struct RealMatrices {
  Eigen::MatrixXd h, g, d, q;
};

/// The s x s stage matrices of one lag, entry by entry.
struct StageSums {
  int lag;
  std::vector<RealMatrices> entries;
};

/// Weights of the Laplace matrices by the contour formula (M9), aliasing about 1e-7: X(Delta/dt)
/// from the eigenvectors of Delta at every point of the upper half circle.
std::vector<StageSums> contour_sums(const TriangleMesh& mesh, const Discretisation& d,
                                    const std::vector<int>& lags) {
  const int stages = d.scheme.stages();
  const Eigen::Index n = 3 * static_cast<Eigen::Index>(mesh.vertices.size());
  const Eigen::MatrixXd square = Eigen::MatrixXd::Zero(n, n), columns = Eigen::MatrixXd::Zero(n, 3);
  std::vector<StageSums> out;
  for (int lag : lags)
    out.push_back(
        {lag, std::vector<RealMatrices>(stages * stages, {square, square, columns, columns})});
  const int length = 2 * (d.history_length + 1);
  const double radius = std::pow(1e-14, 0.5 / length);
  for (int l = 0; l <= length / 2; ++l) {
    const Complex zeta = std::polar(radius, 2 * kPi * l / length);
    const double multiplicity = l == 0 || 2 * l == length ? 1 : 2;  // conjugate points
    const Eigensystem spectrum = eigensystem(d.scheme.delta(zeta));
    const StageMatrixC left = spectrum.vectors, right = inverse(spectrum.vectors);
    for (int e = 0; e < stages; ++e) {
      const LaplaceMatrices m =
          laplace_matrices(mesh, d.material, spectrum.values[e] / d.dt, d.quadrature_tolerance);
      for (StageSums& sums : out)
        for (int i = 0; i < stages * stages; ++i) {
          const Complex factor = multiplicity / length * std::pow(zeta, -sums.lag) *
                                 left(i / stages, e) * right(e, i % stages);
          sums.entries[i].h += (factor * m.h).real();
          sums.entries[i].g += (factor * m.g).real();
          sums.entries[i].d += (factor * m.d).real();
          sums.entries[i].q += (factor * m.q).real();
        }
    }
  }
  return out;
}

}  // namespace

TEST_CASE("lag 0 equals the Laplace matrices at the eigenvalues of Delta(0)/dt") {
  const TriangleMesh mesh = centred(star(1, 1));
  for (const char* name : {"radau2", "radau3", "theta:0.75", "bdf1"})
    for (double nu : {0.0, 0.3, 0.5}) {
      Discretisation d;
      d.material = material(1.3, 2.1, nu);
      d.scheme = Scheme::parse(name);
      d.dt = 0.4;
      d.history_length = 6;
      d.quadrature_tolerance = 1e-7;
      const LagMatrices fast = assemble_all(mesh, d, false);
      int lane = 0;
      for (const InitialComponent& c : d.scheme.initial_components()) {
        // the same quadrature for both paths: the reference at the largest |s| of the scheme
        const LaplaceMatrices exact = laplace_matrices(mesh, d.material, c.eigenvalue / d.dt, 1e-9);
        INFO(name << ", nu " << nu);
        CHECK(relative(fast.h[lane], exact.h.real()) < 1e-6);
        CHECK(relative(fast.g[lane], exact.g.real()) < 1e-6);
        CHECK(relative(fast.d[lane], exact.d.real()) < 1e-6);
        CHECK(relative(fast.q[lane], exact.q.real()) < 1e-6);
        CHECK(relative(fast.c[lane], exact.c.real()) < 1e-6);
        if (c.paired) {
          CHECK(relative(fast.h[lane + 1], exact.h.imag()) < 1e-6);
          CHECK(relative(fast.g[lane + 1], exact.g.imag()) < 1e-6);
          CHECK(relative(fast.c[lane + 1], exact.c.imag()) < 1e-6);
        }
        lane += c.paired ? 2 : 1;
      }
    }
}

TEST_CASE("later lags equal the contour integral of the Laplace matrices") {
  const TriangleMesh mesh = centred(star(0, 1));
  for (const char* name : {"bdf1", "bdf2", "radau2", "radau3"}) {
    Discretisation d;
    d.material = material(1.3, 2.1, 0.3);
    d.scheme = Scheme::parse(name);
    d.dt = 2.0 / (d.material.shear_speed() * 2.0);
    d.history_length = 16;
    d.quadrature_tolerance = 1e-9;
    const LagMatrices fast = assemble_all(mesh, d, false);
    const LaneLayout layout(d.scheme, d.history_length);
    const std::vector<StageSums> exact = contour_sums(mesh, d, {1, 2, 4, 6});
    for (const StageSums& sums : exact)
      for (int row = 0; row < d.scheme.stages(); ++row)
        for (int column = 0; column < d.scheme.stages(); ++column) {
          const auto stage = [&](const std::vector<Eigen::MatrixXd>& lanes) {
            Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(lanes[0].rows(), lanes[0].cols());
            for (int m = 0; m < layout.components; ++m) {
              const LagComponent& c = d.scheme.lag_components()[m];
              sum += c.left[row] * c.right[column] * lanes[layout.lane(sums.lag, m)];
            }
            return sum;
          };
          const RealMatrices& entry = sums.entries[row * d.scheme.stages() + column];
          INFO(name << ", lag " << sums.lag << ", stages " << row << column);
          // relative to the largest stage entry of all these lags
          const auto error = [&](const std::vector<Eigen::MatrixXd>& lanes, auto member) {
            double largest = 0;
            for (const StageSums& lag : exact)
              for (const RealMatrices& e : lag.entries)
                largest = std::max(largest, (e.*member).norm());
            return (stage(lanes) - entry.*member).norm() / largest;
          };
          CHECK(error(fast.h, &RealMatrices::h) < 3e-7);
          CHECK(error(fast.g, &RealMatrices::g) < 3e-7);
          CHECK(error(fast.d, &RealMatrices::d) < 3e-7);
          CHECK(error(fast.q, &RealMatrices::q) < 3e-7);
        }
  }
}

TEST_CASE("the own-block fix makes rigid translation exact and changes little") {
  const TriangleMesh mesh = centred(star(1, 1));
  for (const char* name : {"radau2", "radau3", "bdf2"}) {
    Discretisation d;
    d.material = material(1.3, 2.1, 0.3);
    d.scheme = Scheme::parse(name);
    d.dt = 0.3;
    d.history_length = default_history_length(
        d.scheme, diameter(mesh.vertices) / (d.material.shear_speed() * d.dt));
    d.quadrature_tolerance = 1e-7;
    const LagMatrices fixed = assemble_all(mesh, d, true);
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

TEST_CASE("blocks of every lag reach the tolerance where waves are short") {
  const TriangleMesh mesh = centred(icosphere(2, 1));
  const std::vector<double> areas = vertex_areas(mesh);
  constexpr int kVertex = 17;
  for (const char* name : {"bdf1", "bdf2", "radau2", "radau3"})
    for (double lam : {5.0, std::string(name) == "radau3" ? 8.0 : 20.0}) {
      // an edge is up to 3.3 c2 dt long; radau3 has waves twice as short
      Discretisation d;
      d.material = material(1.3, 2.1, 0.3);
      d.scheme = Scheme::parse(name);
      d.dt = diameter(mesh.vertices) / (lam * d.material.shear_speed());
      d.history_length = default_history_length(d.scheme, lam);
      const auto row_of = [&](double tolerance) {
        d.quadrature_tolerance = tolerance;
        const RowAssembler assembler(mesh, diameter(mesh.vertices), d);
        RowAssembler::Workspace work;
        BlockRow<double> row;
        assembler.assemble(kVertex, false, work, row);
        return row;
      };
      const BlockRow<double> row = row_of(1e-6), exact = row_of(1e-9);
      double worst = 0;
      for (std::size_t j = 0; j < areas.size(); ++j) {
        if (j == kVertex) continue;
        const double r = (mesh.vertices[j] - mesh.vertices[kVertex]).norm();
        const double size = 3 * areas[j] / (4 * kPi * r * r);  // of the static traction kernel
        for (int i = 0; i < 9 * row.padded_lanes; ++i)
          worst = std::max(worst, std::abs(row.h_block(static_cast<int>(j))[i] -
                                           exact.h_block(static_cast<int>(j))[i]) /
                                      size);
      }
      INFO(name << ", lam " << lam);
      CHECK(worst < 1e-6);
      CHECK(worst > 1e-12);
    }
}
