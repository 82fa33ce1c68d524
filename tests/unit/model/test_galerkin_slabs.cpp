#include "base/symmetric_matrix.hpp"
#include "model/galerkin_slabs.hpp"
#include "support/models.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

using Matrix = Eigen::MatrixXd;

/// A model without matrices, of a bar without symmetries that could hide a mistake.
BodyModel empty_model(ModelKind kind, const char* scheme) {
  const Material m = material(1000, 1e6, 0.3);
  BodyModel model;
  model.kind = kind;
  TriangleMesh mesh = box(Vec3(2, 1, 0.7), {3, 1, 1});
  mesh.vertices[0] += Vec3(0.1, 0.05, -0.02);
  model.geometry = geometry_of(mesh, m.density);
  model.discretisation = (kind == ModelKind::dynamic ? options_for(model.geometry, m, scheme, 1.5)
                                                     : quasistatic_options(model.geometry, m))
                             .discretisation;
  model.discretisation.method = SpatialMethod::galerkin;
  return model;
}

MatrixSlab<double> all_rows(BodyModel& model) {
  GalerkinSlabs<double> assembler(model, AssemblyPrecision::full, MatrixForm::general);
  MatrixSlab<double> slab;
  assembler.assemble(0, static_cast<int>(model.nodes()), slab);
  return slab;
}

/// Translations and rotations about the centre of mass.
Matrix rigid_motions(const BodyModel& model) {
  Matrix out(static_cast<Eigen::Index>(3 * model.nodes()), 6);
  for (std::size_t i = 0; i < model.nodes(); ++i)
    out.middleRows<3>(static_cast<Eigen::Index>(3 * i)) << Mat3::Identity(),
        -cross_matrix(model.geometry.nodes.vertices[i]);
  return out;
}

double size_of(const Matrix& m) {
  return m.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("slabs with distant blocks in factors have the same matrices and forces") {
  const Material m = material(1000, 1e6, 0.3);
  const auto bar = [&] {
    BodyModel model;
    model.kind = ModelKind::dynamic;
    model.geometry = geometry_of(box(Vec3(32, 1, 0.8), {48, 2, 2}), m.density);
    model.discretisation = options_for(model.geometry, m, "theta:0.75", 4).discretisation;
    model.discretisation.method = SpatialMethod::galerkin;
    model.loads = Loads::some;
    for (int node = 0; node < static_cast<int>(model.nodes()); node += 2)
      model.loaded_nodes.push_back(node);
    return model;
  };
  BodyModel entire = bar(), parted = bar();
  const std::vector<Slab> slabs = make_partition(entire.geometry.nodes.vertices, {});
  GalerkinSlabs<float> entries(entire, AssemblyPrecision::single, MatrixForm::symmetric),
      factors(parted, AssemblyPrecision::single, MatrixForm::symmetric);
  factors.use_factors(slabs);
  const auto norms = factors.estimate_norms();
  const double size = 3.0 * static_cast<double>(parted.nodes());
  const auto error = [&](double norm, int matrices) {
    return 1e-6 * norm / (size * std::sqrt(matrices));
  };
  factors.allow_errors(
      {error(norms.h, factors.lag_count()), error(norms.initial_inertia, factors.initial_count()),
       error(norms.g, factors.lag_count()), error(norms.initial_g, factors.initial_count()),
       error(norms.stiffness, 1)});
  std::size_t blocks = 0;
  double squares[5] = {}, of[5] = {};
  for (const Slab& s : slabs) {
    MatrixSlab<float> a, b;
    entries.assemble(s.row_begin, s.row_end, a);
    factors.assemble(s.row_begin, s.row_end, b);
    blocks += b.far.size();
    const auto compare = [&](int kind, const auto& found, const auto& expected,
                             const ColumnPlaces& columns, bool upper, auto factored) {
      for (std::size_t k = 0; k < expected.size(); ++k)
        for (int node = upper ? s.row_begin : 0; node < static_cast<int>(parted.nodes()); ++node) {
          const Matrix wanted = expected[k].middleCols(3 * node, 3).template cast<double>();
          of[kind] += wanted.squaredNorm();
          if (columns.holds(node)) {
            squares[kind] +=
                (found[k].middleCols(3 * columns.place[node], 3).template cast<double>() - wanted)
                    .squaredNorm();
            continue;
          }
          for (const FarBlock& f : b.far) {
            if (node < f.columns.begin || node >= f.columns.end) continue;
            squares[kind] +=
                (factored(f, k).middleCols(3 * (node - f.columns.begin), 3) -
                 wanted.middleRows(3 * (f.rows.begin - s.row_begin), 3 * f.rows.size()))
                    .squaredNorm();
          }
        }
    };
    const auto times = [](const FactoredMatrices& f, std::size_t k) -> Matrix {
      return (f.outputs * f.inputs[k]).cast<double>();
    };
    const std::size_t initial = b.initial_h.size();
    compare(0, b.h, a.h, b.h_columns, true,
            [&](const FarBlock& f, std::size_t k) { return times(f.inertia, k + initial); });
    compare(1, b.g, a.g, b.g_columns, false,
            [&](const FarBlock& f, std::size_t k) { return times(f.tractions, k + initial); });
    compare(2, b.initial_h, a.initial_h, b.h_columns, true, [&](const FarBlock& f, std::size_t k) {
      return Matrix(times(f.inertia, k) + times(f.stiffness, 0));
    });
    compare(3, b.initial_g, a.initial_g, b.g_columns, false,
            [&](const FarBlock& f, std::size_t k) { return times(f.tractions, k); });
    compare(4, std::vector<Matrix>{b.stiffness}, std::vector<Matrix>{a.stiffness}, b.h_columns,
            true, [&](const FarBlock& f, std::size_t) { return times(f.stiffness, 0); });
  }
  CHECK(blocks >= 4);
  for (int kind = 0; kind < 5; ++kind) {
    INFO("kind " << kind);
    CHECK(std::sqrt(squares[kind] / of[kind]) < 2e-6);
    CHECK(of[kind] > 0);
  }
  const auto compare_all = [](const auto& found, const auto& expected, double tolerance) {
    double difference = 0, largest = 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
      difference = std::max(difference, (found[k] - expected[k]).cwiseAbs().maxCoeff());
      largest = std::max(largest, expected[k].cwiseAbs().maxCoeff());
    }
    CHECK(difference < tolerance * largest);
    CHECK(largest > 0);
  };
  compare_all(parted.body_force, entire.body_force, 5e-5);
  compare_all(parted.initial_body_force, entire.initial_body_force, 1e-5);
  compare_all(parted.centrifugal, entire.centrifugal, 5e-5);
  compare_all(parted.initial_centrifugal, entire.initial_centrifugal, 1e-5);
  compare_all(parted.traction_moments, entire.traction_moments, 1e-5);
}

TEST_CASE("slabs of Galerkin rows are pieces of the whole") {
  const MatrixForm form = GENERATE(MatrixForm::general, MatrixForm::symmetric);
  for (const char* scheme : {"radau2", "bdf2"}) {
    BodyModel model = empty_model(ModelKind::dynamic, scheme),
              other = empty_model(ModelKind::dynamic, scheme);
    const MatrixSlab<double> whole = all_rows(model);
    GalerkinSlabs<double> assembler(other, AssemblyPrecision::full, form);
    const int n = static_cast<int>(model.nodes());
    CHECK(assembler.is_inertial());
    // backwards, so that no slab finds its rows in memory
    for (const auto& [first, last] : {std::pair(2 * n / 3, n), {n / 3, 2 * n / 3}, {0, n / 3}}) {
      MatrixSlab<double> slab;
      assembler.assemble(first, last, slab);
      const auto compare = [&, at = first, rows = last - first](const std::vector<Matrix>& found,
                                                                const std::vector<Matrix>& from,
                                                                MatrixForm of) {
        REQUIRE(found.size() == from.size());
        const Eigen::Index columns = 3 * (of == MatrixForm::symmetric ? n - at : n);
        for (std::size_t k = 0; k < found.size(); ++k)
          CHECK(size_of(found[k].rightCols(columns) -
                        from[k].middleRows(3 * at, 3 * rows).rightCols(columns)) <=
                1e-13 * size_of(from[k]));
      };
      compare(slab.h, whole.h, form);
      compare(slab.g, whole.g, MatrixForm::general);
      compare(slab.initial_h, whole.initial_h, form);
      compare(slab.initial_g, whole.initial_g, MatrixForm::general);
      compare({slab.stiffness}, {whole.stiffness}, form);
    }
    for (std::size_t k = 0; k < model.body_force.size(); ++k) {
      CHECK(size_of(other.body_force[k] - model.body_force[k]) <=
            1e-13 * size_of(model.body_force[k]));
      CHECK(size_of(other.centrifugal[k] - model.centrifugal[k]) <=
            1e-13 * size_of(model.centrifugal[k]));
    }
  }
}

TEST_CASE("the norms of Galerkin families are those of their matrices") {
  BodyModel model = empty_model(ModelKind::dynamic, "radau2");
  const MatrixSlab<double> slab = all_rows(model);
  const auto norm = [](const std::vector<Matrix>& matrices) {
    double sum = 0;
    for (const Matrix& m : matrices) sum += m.squaredNorm();
    return std::sqrt(sum);
  };
  const MatrixForm form = GENERATE(MatrixForm::general, MatrixForm::symmetric);
  const auto found = GalerkinSlabs<double>(model, AssemblyPrecision::full, form).estimate_norms();
  CHECK(found.h == Approx(norm(slab.h)).epsilon(1e-9));
  CHECK(found.g == Approx(norm(slab.g)).epsilon(1e-9));
  CHECK(found.initial_h == Approx(norm(slab.initial_h)).epsilon(1e-9));
  CHECK(found.initial_g == Approx(norm(slab.initial_g)).epsilon(1e-9));
  CHECK(found.stiffness == Approx(slab.stiffness.norm()).epsilon(1e-9));
}

TEST_CASE("Galerkin matrices are symmetric, without forces of translations") {
  BodyModel model = empty_model(ModelKind::dynamic, "bdf1");
  const MatrixSlab<double> slab = all_rows(model);
  const Matrix rigid = rigid_motions(model);
  const auto asymmetry = [](const Matrix& m) { return size_of(m - m.transpose()) / size_of(m); };
  CHECK(asymmetry(slab.stiffness) < 1e-12);
  CHECK(asymmetry(slab.initial_h[0]) < 1e-12);
  for (const Matrix& z : slab.h) CHECK(size_of(z - z.transpose()) < 1e-12 * size_of(slab.h[0]));
  CHECK(size_of(slab.stiffness * rigid.leftCols<3>()) < 1e-12 * size_of(slab.stiffness));
  // H_0 = D(0) + Z_0/dt^2, and [D Q] = -Z R of lag 0 and later ones
  const double dt = model.discretisation.dt;
  const Matrix initial = dt * dt * (slab.initial_h[0] - slab.stiffness);
  const Matrix expected = -initial * rigid;
  CHECK(size_of(model.initial_body_force[0].real() - expected) < 1e-10 * size_of(expected));
  for (std::size_t k = 0; k < slab.h.size(); ++k)
    CHECK(size_of(model.body_force[k] + slab.h[k] * rigid) < 1e-10 * size_of(expected));
}

TEST_CASE("rigid motions of the static Galerkin matrices have the body's mass and inertia") {
  double previous = 1;
  for (const auto& [tolerance, bound] : {std::pair(1e-6, 1e-3), {1e-9, 1e-5}}) {
    BodyModel model = empty_model(ModelKind::quasistatic, "bdf1");
    model.discretisation.quadrature_tolerance = tolerance;
    const MatrixSlab<double> slab = all_rows(model);
    CHECK(slab.h.empty());
    CHECK(slab.stiffness.size() == 0);
    const Matrix rigid = rigid_motions(model);
    // D(0) of rotations is an error of the quadrature
    const double turned = size_of(slab.initial_h[0] * rigid) / size_of(slab.initial_h[0]);
    CHECK(turned < 1e-2 * bound);
    const Matrix mass = -rigid.transpose() * model.initial_body_force[0].real();
    Matrix expected = Matrix::Zero(6, 6);
    expected.diagonal().head<3>().setConstant(model.geometry.mass.mass);
    expected.bottomRightCorner<3, 3>() = model.geometry.mass.inertia;
    const double error = size_of(mass - expected) / size_of(expected);
    std::printf("tolerance %g: mass %.1e, D(0) of rotations %.1e\n", tolerance, error, turned);
    CHECK(error < bound);
    CHECK(error < 0.5 * previous);
    previous = error;
  }
}
