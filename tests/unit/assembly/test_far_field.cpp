#include "assembly/far_field.hpp"
#include "assembly/galerkin_assembler.hpp"
#include "mesh/body_geometry.hpp"
#include "mesh/extent.hpp"
#include "support/bodies.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

/// A bar whose ends are far from each other.
struct Bar {
  Bar(const char* scheme, double damping = 0) {
    nodes = make_geometry(make_surface(box(Vec3(16, 1, 0.8), {24, 2, 2}), "bar"), 1000).nodes;
    size = diameter(nodes.vertices);
    d.material = material(1000, 1e6, 0.3);
    d.scheme = Scheme::parse(scheme);
    d.dt = size / (4 * d.material.shear_speed());
    d.damping.time = damping * d.dt;
    d.history_length = 7;
    d.quadrature_tolerance = 1e-6;
    d.method = SpatialMethod::galerkin;
  }
  TriangleMesh nodes;
  double size;
  Discretisation d;
};

/// Nodes [begin, end) that all lie beyond this place along the bar, or before it.
NodeRange nodes_at_end(const TriangleMesh& mesh, bool right) {
  NodeRange best;
  int begin = 0;
  const int n = static_cast<int>(mesh.vertices.size());
  for (int i = 0; i <= n; ++i) {
    const bool wanted = i < n && (right ? mesh.vertices[i][0] > 4 : mesh.vertices[i][0] < -4);
    if (wanted) continue;
    if (i - begin > best.size()) best = {begin, i};
    begin = i + 1;
  }
  return best;
}

struct Difference {
  double squares = 0, of = 0;
  void note(double found, double expected) {
    squares += (found - expected) * (found - expected);
    of += expected * expected;
  }
  double relative() const { return std::sqrt(squares / of); }
};

}  // namespace

TEST_CASE("distant blocks in factors are those that are assembled entry by entry") {
  const auto [scheme, damping] =
      GENERATE(std::pair("radau2", 0.0), std::pair("bdf2", 0.3), std::pair("theta:0.75", 0.0));
  const Bar bar(scheme, damping);
  const GalerkinAssembler assembler(bar.nodes, bar.size, bar.d);
  const LaneLayout layout = assembler.layout();
  const GalerkinCombination combination(bar.d, layout);
  const FarField far(bar.nodes, assembler.reconstruction(), assembler.pairs(), combination, layout);
  const NodeRange rows = nodes_at_end(bar.nodes, false), columns = nodes_at_end(bar.nodes, true);
  REQUIRE(std::min(rows.size(), columns.size()) > 20);
  CHECK(far.holds(rows, columns));
  CHECK_FALSE(far.holds(rows, rows));

  GalerkinRows<double> exact;
  assembler.assemble(rows.begin, rows.end, MatrixForm::general, exact);
  std::vector<char> loaded(bar.nodes.vertices.size(), 1);
  loaded[columns.begin + 2] = 0;
  const FarTask task{rows, columns, true, &loaded, {}};
  double largest[2] = {}, stiffest = 0;  // of Z and of G with all its lanes
  const int count = layout.count();
  std::vector<double> lanes(count);
  for (int i = 0; i < rows.size(); ++i)
    for (int j = columns.begin; j < columns.end; ++j)
      for (int e = 0; e < 9; ++e) {
        const double* z = exact.inertia_block(i, j) + e * exact.padded_lanes;
        for (int lane = 0; lane < count; ++lane)
          largest[0] = std::max(largest[0], std::abs(z[lane]));
        combination.g(exact.static_g_block(i, j)[e],
                      exact.adjoint_block(i, j) + e * exact.padded_lanes, lanes.data());
        for (double g : lanes) largest[1] = std::max(largest[1], std::abs(g));
        stiffest = std::max(stiffest, std::abs(exact.static_h_block(i, j)[e]));
      }
  const double unit = bar.d.dt * bar.d.dt;  // of Z in lag 0
  const double tolerance = 1e-6;
  const FarErrors errors{tolerance * largest[0], tolerance * largest[0] / unit,
                         tolerance * largest[1], tolerance * largest[1], tolerance * stiffest};
  const FarBlock block = far.factor(task, errors, assembler.table().lanes());
  CHECK(block.inertia.outputs.cols() < 5 * rows.size() / 2);
  CHECK(block.tractions.outputs.cols() < 5 * rows.size() / 2);

  Difference h, initial_h, g, stiffness, rigid, unloaded;
  std::vector<Eigen::MatrixXd> z(count), p(count);
  for (int lane = 0; lane < count; ++lane) {
    z[lane] = (block.inertia.outputs * block.inertia.inputs[lane]).cast<double>();
    p[lane] = (block.tractions.outputs * block.tractions.inputs[lane]).cast<double>();
  }
  const Eigen::MatrixXd k = (block.stiffness.outputs * block.stiffness.inputs[0]).cast<double>();
  double moved = 0;
  for (int i = 0; i < rows.size(); ++i) {
    for (int j = columns.begin; j < columns.end; ++j)
      for (int e = 0; e < 9; ++e) {
        const Eigen::Index r = 3 * i + e / 3, c = 3 * (j - columns.begin) + e % 3;
        const double* from = exact.inertia_block(i, j) + e * exact.padded_lanes;
        combination.initial_h(0.0, from, lanes.data());
        for (int lane = 0; lane < count; ++lane) {
          if (lane < layout.initial)
            initial_h.note(z[lane](r, c), lanes[lane]);
          else
            h.note(z[lane](r, c), from[lane]);
        }
        combination.g(exact.static_g_block(i, j)[e],
                      exact.adjoint_block(i, j) + e * exact.padded_lanes, lanes.data());
        for (int lane = 0; lane < count; ++lane)
          if (j == columns.begin + 2)
            moved = std::max(moved, std::abs(p[lane](r, c)));
          else
            g.note(p[lane](r, c), lanes[lane]);
        stiffness.note(k(r, c), exact.static_h_block(i, j)[e]);
      }
    // forces of a translation along the bar
    for (int lane = 0; lane < count; ++lane)
      for (int axis = 0; axis < 3; ++axis) {
        double sum = 0;
        for (int j = columns.begin; j < columns.end; ++j)
          sum -= exact.inertia_block(i, j)[3 * axis * exact.padded_lanes + lane];
        rigid.note(
            block.row_forces[(std::size_t(i) * FarBlock::kForces + 6 * axis) * exact.padded_lanes +
                             lane],
            sum);
      }
  }
  CHECK(h.relative() < 1e-3);
  CHECK(initial_h.relative() < 1e-3);
  CHECK(g.relative() < 1e-3);
  CHECK(moved == 0);
  CHECK(stiffness.relative() < 1e-3);
  CHECK(rigid.relative() < 1e-3);

  // the mirror image of the first node's force
  Difference mirrored;
  for (int j = columns.begin; j < columns.end; ++j)
    for (int lane = 0; lane < count; ++lane)
      for (int axis = 0; axis < 3; ++axis) {
        double sum = 0;
        for (int i = 0; i < rows.size(); ++i)
          sum -= exact.inertia_block(i, j)[axis * exact.padded_lanes + lane];
        mirrored.note(
            block.column_forces[(std::size_t(j - columns.begin) * FarBlock::kForces + 6 * axis) *
                                    exact.padded_lanes +
                                lane],
            sum);
      }
  CHECK(mirrored.relative() < 1e-3);
}
