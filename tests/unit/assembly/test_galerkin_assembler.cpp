#include "assembly/galerkin_assembler.hpp"
#include "mesh/extent.hpp"
#include "support/bodies.hpp"
#include "support/galerkin_laplace.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

Discretisation discretisation(const char* scheme, double extent, double poisson) {
  Discretisation d;
  d.material = material(1000, 1e6, poisson);
  d.scheme = Scheme::parse(scheme);
  d.dt = extent / (2 * d.material.shear_speed());
  d.history_length = 5;
  d.quadrature_tolerance = 1e-6;
  d.method = SpatialMethod::galerkin;
  return d;
}

double difference(const Eigen::MatrixXcd& found, const Eigen::MatrixXcd& expected) {
  return (found - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

/// Rows of H, G, [D Q] of an initial component from the lanes of lag 0.
template <class T>
LaplaceMatrices matrices_of(const GalerkinRows<T>& rows, const GalerkinCombination& combination,
                            const InitialComponent& component, int first_lane, int lanes) {
  const int count = rows.last - rows.first, n = rows.nodes;
  LaplaceMatrices out;
  out.h = out.g = Eigen::MatrixXcd::Zero(3 * count, 3 * n);
  std::vector<double> h(lanes), g(lanes);
  const auto value = [&](const std::vector<double>& from) {
    return Complex(from[first_lane], component.paired ? from[first_lane + 1] : 0.0);
  };
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < n; ++j)
      for (int e = 0; e < 9; ++e) {
        const Eigen::Index r = 3 * i + e / 3, c = 3 * j + e % 3;
        combination.initial_h(rows.static_h_block(i, j)[e],
                              rows.inertia_block(i, j) + e * rows.padded_lanes, h.data());
        combination.g(rows.static_g_block(i, j)[e],
                      rows.adjoint_block(i, j) + e * rows.padded_lanes, g.data());
        out.h(r, c) = value(h);
        out.g(r, c) = value(g);
      }
  return out;
}

/// D(0) of rows that have all columns; M/2 - K'(0).
template <class T>
Eigen::MatrixXd static_h_of(const GalerkinRows<T>& rows) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * (rows.last - rows.first), 3 * rows.nodes);
  for (int i = 0; i < rows.last - rows.first; ++i)
    for (int j = 0; j < rows.nodes; ++j)
      if (rows.part(i).h.holds(j))
        for (int e = 0; e < 9; ++e)
          out(3 * i + e / 3, 3 * j + e % 3) = rows.static_h_block(i, j)[e];
  return out;
}
template <class T>
Eigen::MatrixXd static_g_of(const GalerkinRows<T>& rows) {
  Eigen::MatrixXd out(3 * (rows.last - rows.first), 3 * rows.nodes);
  for (int i = 0; i < rows.last - rows.first; ++i)
    for (int j = 0; j < rows.nodes; ++j)
      for (int e = 0; e < 9; ++e) out(3 * i + e / 3, 3 * j + e % 3) = rows.static_g_block(i, j)[e];
  return out;
}

}  // namespace

TEST_CASE("assembled rows of lag 0 are those of the scalar reference") {
  // the reference resolves all waves, assemblers only those up to |s| dt = 1
  constexpr double tolerance = 1e-4;
  const std::pair<TriangleMesh, const char*> cases[] = {
      {random_tetrahedron(7), "radau2"}, {box(Vec3(1, 0.6, 0.5), {3, 1, 1}), "theta:0.5"}};
  for (const auto& [mesh, scheme] : cases) {
    const TriangleMesh nodes = centred(mesh);
    const double size = diameter(nodes.vertices);
    const Discretisation d = discretisation(scheme, size, 0.3);
    const GalerkinAssembler assembler(nodes, size, d);
    const GalerkinCombination combination(d, assembler.layout());
    const int n = static_cast<int>(nodes.vertices.size()), first = n / 3, last = 2 * n / 3;
    GalerkinRows<double> rows;
    assembler.assemble(first, last, MatrixForm::general, rows);
    GalerkinRows<float> narrow;
    assembler.assemble(first, last, MatrixForm::general, narrow);
    int lane = 0;
    for (const InitialComponent& c : d.scheme.initial_components()) {
      const LaplaceMatrices expected =
          galerkin_laplace_matrices(nodes, assembler.reconstruction(), d.material,
                                    c.eigenvalue / d.dt, d.quadrature_tolerance);
      const auto part = [&](const Eigen::MatrixXcd& m) {
        return Eigen::MatrixXcd(m.middleRows(3 * first, 3 * (last - first)));
      };
      INFO(scheme << ", " << n << " nodes");
      const int lanes = assembler.layout().count();
      const LaplaceMatrices found = matrices_of(rows, combination, c, lane, lanes);
      CHECK(difference(found.h, part(expected.h)) < tolerance);
      CHECK(difference(found.g, part(expected.g)) < tolerance);
      const LaplaceMatrices single = matrices_of(narrow, combination, c, lane, lanes);
      CHECK(difference(single.h, part(expected.h)) < tolerance);
      CHECK(difference(single.g, part(expected.g)) < tolerance);
      lane += c.paired ? 2 : 1;
    }
  }
}

TEST_CASE("loads on triangles are those of nodal tractions where these are the same") {
  const TriangleMesh nodes = centred(box(Vec3(1, 0.6, 0.5), {2, 1, 1}));
  const double size = diameter(nodes.vertices);
  const Discretisation d = discretisation("radau2", size, 0.3);
  const GalerkinAssembler assembler(nodes, size, d);
  const GalerkinCombination combination(d, assembler.layout());
  const int n = static_cast<int>(nodes.vertices.size()), lanes = assembler.layout().count();
  GalerkinRows<double> rows;
  assembler.assemble(0, n, MatrixForm::general, rows);
  // all triangles around node 1 with its hat function
  std::vector<PanelLoad> loads;
  for (int t = 0; t < static_cast<int>(nodes.triangles.size()); ++t)
    for (int k = 0; k < 3; ++k)
      if (nodes.triangles[t][k] == 1) loads.push_back({t, Eigen::Matrix3d::Identity(), k});
  const std::vector<Eigen::MatrixXd> found = assembler.assemble_loads(loads);
  double worst = 0, largest = 0;
  std::vector<double> out(lanes);
  for (int i = 0; i < n; ++i)
    for (int e = 0; e < 9; ++e) {
      combination.g(rows.static_g_block(i, 1)[e], rows.adjoint_block(i, 1) + e * rows.padded_lanes,
                    out.data());
      for (int lane = 0; lane < lanes; ++lane) {
        worst = std::max(worst, std::abs(found[lane](3 * i + e / 3, e % 3) - out[lane]));
        largest = std::max(largest, std::abs(out[lane]));
      }
    }
  CHECK(worst < 2e-6 * largest);
}

TEST_CASE("patches that are close are integrated by the rules of triangles, not by midpoints") {
  const TriangleMesh nodes = centred(box(Vec3(1, 1, 1), {6, 6, 6}));
  const double size = diameter(nodes.vertices);
  Discretisation d = discretisation("bdf1", size, 0.3);
  const int n = static_cast<int>(nodes.vertices.size());
  GalerkinRows<double> rows, exact;
  GalerkinAssembler(nodes, size, d).assemble(0, 1, MatrixForm::general, rows);
  d.quadrature_tolerance = 1e-8;
  GalerkinAssembler(nodes, size, d).assemble(0, 1, MatrixForm::general, exact);
  const auto error = [n](const auto& found, const auto& expected, std::size_t size_of_entry) {
    double difference = 0, all = 0;
    for (std::size_t i = 0; i < 9 * size_of_entry * static_cast<std::size_t>(n); ++i) {
      difference += (found[i] - expected[i]) * (found[i] - expected[i]);
      all += expected[i] * expected[i];
    }
    return std::sqrt(difference / all);
  };
  const std::size_t lanes = rows.padded_lanes;
  CHECK(error(rows.static_h, exact.static_h, 1) < 4e-5);
  CHECK(error(rows.static_g, exact.static_g, 1) < 5e-5);
  CHECK(error(rows.inertia, exact.inertia, lanes) < 1.8e-3);
  CHECK(error(rows.adjoint, exact.adjoint, lanes) < 3.6e-3);
}

TEST_CASE("distant patches are summed by midpoints as well as by pairs of triangles") {
  const TriangleMesh nodes = centred(box(Vec3(10, 0.8, 0.8), {10, 1, 1}));
  const double size = diameter(nodes.vertices);
  Discretisation d = discretisation("bdf1", size, 0.3);
  const int n = static_cast<int>(nodes.vertices.size());
  GalerkinRows<float> rows, exact;
  GalerkinAssembler(nodes, size, d).assemble(0, n, MatrixForm::general, rows);
  d.quadrature_tolerance = 1e-8;  // the rule of the midpoints is too coarse for it
  GalerkinAssembler(nodes, size, d).assemble(0, n, MatrixForm::general, exact);
  double worst[4] = {}, largest[4] = {};
  int pairs = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if ((nodes.vertices[i] - nodes.vertices[j]).norm() < 7) continue;
      ++pairs;
      const auto compare = [&](int kind, double found, double expected) {
        worst[kind] = std::max(worst[kind], std::abs(found - expected));
        largest[kind] = std::max(largest[kind], std::abs(expected));
      };
      for (int e = 0; e < 9; ++e) {
        compare(0, rows.static_h_block(i, j)[e], exact.static_h_block(i, j)[e]);
        compare(1, rows.static_g_block(i, j)[e], exact.static_g_block(i, j)[e]);
        for (int lane = 0; lane < rows.padded_lanes; ++lane) {
          const int at = e * rows.padded_lanes + lane;
          compare(2, rows.inertia_block(i, j)[at], exact.inertia_block(i, j)[at]);
          compare(3, rows.adjoint_block(i, j)[at], exact.adjoint_block(i, j)[at]);
        }
      }
    }
  CHECK(pairs > 100);
  // terms of D(0) cancel, the more the farther two nodes are apart: errors are of those of near
  // ones
  largest[0] = 1e-2 * static_h_of(exact).cwiseAbs().maxCoeff();
  for (int kind = 0; kind < 4; ++kind) {
    INFO("kind " << kind << ": " << worst[kind] << " of " << largest[kind]);
    CHECK(worst[kind] < 4e-3 * largest[kind]);
  }
  double strain = 0, most = 0;
  for (std::size_t i = 0; i < rows.strain.size(); ++i) {
    strain = std::max(strain, std::abs(rows.strain[i] - exact.strain[i]));
    most = std::max(most, std::abs(exact.strain[i]));
  }
  CHECK(strain < 2e-4 * most);
}

TEST_CASE("entries on and beyond the diagonal are those of whole rows, which are symmetric") {
  const TriangleMesh nodes = centred(box(Vec3(10, 0.8, 0.8), {10, 1, 1}));
  const double size = diameter(nodes.vertices);
  const Discretisation d = discretisation("bdf1", size, 0.3);
  const GalerkinAssembler assembler(nodes, size, d);
  const int n = static_cast<int>(nodes.vertices.size()), middle = n / 2;
  GalerkinRows<double> whole, upper, mirrored;
  assembler.assemble(0, n, MatrixForm::general, whole);
  assembler.assemble(middle, n, MatrixForm::symmetric, upper);
  assembler.assemble(0, n, MatrixForm::symmetric, mirrored);
  CHECK(upper.inertia.size() < whole.inertia.size() / 3);
  const double tiny = 1e-13;
  const Eigen::MatrixXd whole_h = static_h_of(whole), whole_g = static_g_of(whole),
                        upper_h = static_h_of(upper), mirrored_h = static_h_of(mirrored);
  double largest = 0, worst[6] = {};
  for (int i = 0; i < 3 * n; ++i)
    for (int j = 0; j < 3 * n; ++j) {
      const int lanes = whole.padded_lanes, from = 3 * (i % 3) + j % 3, back = 3 * (j % 3) + i % 3;
      const double z = whole.inertia_block(i / 3, j / 3)[from * lanes];
      const auto note = [&](int kind, double difference) {
        worst[kind] = std::max(worst[kind], std::abs(difference));
      };
      largest = std::max(largest, std::abs(z));
      note(0, whole_h(i, j) - whole_h(j, i));
      note(1, z - whole.inertia_block(j / 3, i / 3)[back * lanes]);
      if (j / 3 < i / 3) continue;
      note(4, mirrored_h(i, j) - whole_h(i, j));
      note(5, mirrored.inertia_block(i / 3, j / 3)[from * lanes] - z);
      if (i < 3 * middle) continue;
      note(2, upper_h(i - 3 * middle, j) - whole_h(i, j));
      note(3, upper.inertia_block(i / 3 - middle, j / 3)[from * lanes] - z);
    }
  const double stiffness = whole_h.cwiseAbs().maxCoeff();
  CHECK(worst[0] < tiny * stiffness);
  CHECK(worst[1] < tiny * largest);
  CHECK(worst[2] < tiny * stiffness);
  CHECK(worst[3] < tiny * largest);
  CHECK(worst[4] < tiny * stiffness);
  CHECK(worst[5] < tiny * largest);
  CHECK((static_g_of(upper) - whole_g.bottomRows(3 * (n - middle))).norm() < tiny * whole_g.norm());
  // a translation has no stiffness
  const Eigen::MatrixXd moves = Mat3::Identity().replicate(n, 1);
  CHECK((whole_h * moves).cwiseAbs().maxCoeff() < 1e-12 * stiffness);
}
