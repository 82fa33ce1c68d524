#include "archive/user_block.hpp"
#include "compress/haar_family.hpp"
#include "files/hdf5.hpp"
#include "support/archives.hpp"

#include <algorithm>
#include <numeric>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

void check_same(const MatrixFamily& a, const MatrixFamily& b) {
  REQUIRE(a.count() == b.count());
  CHECK(a.bytes() == b.bytes());
  for (int k = 0; k < a.count(); ++k) CHECK(full_matrix(a, k) == full_matrix(b, k));
}

void check_same(const std::vector<std::unique_ptr<MatrixFamily>>& a,
                const std::vector<std::unique_ptr<MatrixFamily>>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) check_same(*a[i], *b[i]);
}

std::vector<int> rows_of(const MatrixFamily& family) {
  std::vector<int> rows(family.rows());
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

void check_motion(const BodyModel& a, const BodyModel& b) {
  check_same(*a.h, *b.h);
  check_same(a.inverse, b.inverse);
  CHECK(a.body_force == b.body_force);
  CHECK(a.initial_body_force == b.initial_body_force);
  REQUIRE(a.balance.rows() == 6);
  CHECK(a.balance == b.balance);
  REQUIRE(a.traction_balance.rows() == 6);
  CHECK(a.traction_balance == b.traction_balance);
}

void check_small_parts(const BodyModel& a, const BodyModel& b) {
  const BodyGeometry &x = a.geometry, &y = b.geometry;
  CHECK(x.input.vertices == y.input.vertices);
  CHECK(x.input.triangles == y.input.triangles);
  CHECK(x.nodes.vertices == y.nodes.vertices);
  CHECK(x.nodes.triangles == y.nodes.triangles);
  CHECK(x.node_of_vertex == y.node_of_vertex);
  CHECK(x.triangle_order == y.triangle_order);
  CHECK(x.mass.volume == y.mass.volume);
  CHECK(x.mass.mass == y.mass.mass);
  CHECK(x.mass.centre == y.mass.centre);
  CHECK(x.mass.inertia == y.mass.inertia);
  CHECK(x.extent == y.extent);
  const Discretisation &d = a.discretisation, &e = b.discretisation;
  CHECK(d.scheme.name() == e.scheme.name());
  CHECK(d.dt == e.dt);
  CHECK(d.history_length == e.history_length);
  CHECK(d.quadrature_tolerance == e.quadrature_tolerance);
  CHECK(d.material.name == e.material.name);
  CHECK(d.material.density == e.material.density);
  CHECK(d.material.shear_modulus == e.material.shear_modulus);
  CHECK(d.material.poisson_ratio == e.material.poisson_ratio);
  CHECK(d.material.time_step == e.material.time_step);
  CHECK(a.window == b.window);
  CHECK(a.report.lam == b.report.lam);
  CHECK(a.report.row_sum_residual == b.report.row_sum_residual);
  CHECK(a.report.rotation_residual == b.report.rotation_residual);
  CHECK(a.report.condition == b.report.condition);
  CHECK(a.report.growth == b.report.growth);
}

/// Of the Galerkin method, with energies.
BodyModel energetic_model(const CodecOptions& codec) {
  PrecomputeOptions options;
  options.discretisation.material = material(1000, 1e5, 0.3);
  options.discretisation.scheme = Scheme::parse("bdf1");
  options.discretisation.method = SpatialMethod::galerkin;
  options.discretisation.dt = 0.01;
  options.discretisation.history_length = 4;
  options.codec = codec;
  options.measure_growth = false;
  options.energies = true;
  return precompute(small_body(), options);
}

}  // namespace

TEST_CASE("A model comes back from its archive bit by bit") {
  const test::TemporaryFolder folder("round_trip");
  const std::string scheme = GENERATE("radau2", "theta:0.75", "bdf1");
  const Precision precision = GENERATE(Precision::float32, Precision::float64);
  CAPTURE(scheme, static_cast<int>(precision));
  BodyModel model = small_model(scheme, CodecOptions(codec_named("none", precision)));
  model.report.growth = 1.25;
  write_archive(folder / "a.bem", model, provenance(), false);
  const Archive archive(folder / "a.bem");
  const BodyModel back = archive.load_all();
  check_small_parts(model, back);
  check_motion(model, back);
  check_same(*model.g, *back.g);
  check_same(model.traction_response, back.traction_response);
  CHECK(archive.matrix_paths().size() ==
        2u * (model.h->count() + (model.discretisation.scheme.is_multistep() ? 1 : 2)));
  CHECK(archive.provenance().program == "bem 0.0.0");
  CHECK(archive.provenance().mesh_file == "sphere.obj");
  CHECK(archive.provenance().material_file == "rubber.json");
  CHECK(archive.provenance().mesh_scale == 0.5);
  CHECK(archive.provenance().options == "--scheme radau2");
}

TEST_CASE("A compressed model comes back from its archive bit by bit, whole or in part") {
  const test::TemporaryFolder folder("compressed");
  const std::string scheme = GENERATE("radau2", "theta:0.75");
  const std::string codec = GENERATE("haar", "lowrank");
  const BodyModel model = small_model(scheme, CodecOptions(codec_named(codec)));
  write_archive(folder / "a.bem", model, provenance(), false);
  const Archive archive(folder / "a.bem");
  CHECK(archive.codec().name() == codec);
  const BodyModel back = archive.load_all();
  check_small_parts(model, back);
  check_motion(model, back);
  check_same(*model.g, *back.g);
  check_same(model.traction_response, back.traction_response);
  CHECK_NOTHROW(archive.check_matrices());

  const std::vector<int> columns = unknowns_of({3, 40});
  const TractionData part = archive.load_tractions({3, 40});
  CHECK(part.lags->block(2, rows_of(*model.g), columns) ==
        model.g->block(2, rows_of(*model.g), columns));
  const Eigen::VectorXd values = Eigen::VectorXd::Random(6);
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(126), some = whole;
  model.g->multiply_add(std::vector<SparseTerm>{{2, &columns, values.data(), 0}}, {whole.data()});
  part.lags->multiply_add(std::vector<SparseTerm>{{2, &columns, values.data(), 0}}, {some.data()});
  if (codec == "lowrank") CHECK(whole == some);
  CHECK((whole - some).norm() < 1e-6 * whole.norm());

  std::vector<double> row(126);
  archive.read_matrix_rows("/matrices/h/lag_002/component_0", 5, 1, row.data());
  const Eigen::MatrixXd expected = full_matrix(*model.h, model.lag_index(2, 0));
  for (int j = 0; j < 126; ++j) CHECK(row[j] == expected(5, j));
}

TEST_CASE("A Haar compressed archive whose tables do not fit its data is refused") {
  const test::TemporaryFolder folder("haar_damage");
  const BodyModel model = small_model("bdf1", CodecOptions(codec_named("haar")));
  const std::string path = folder / "a.bem";
  write_archive(path, model, provenance(), false);
  const std::string intact = file_bytes(path);
  // datasets are contiguous: their own bytes are found and changed, and the file is sealed again
  const auto refusal = [&](const std::string& bytes, std::size_t at) {
    const std::size_t place = intact.find(bytes);
    REQUIRE(place != std::string::npos);
    std::string damaged = intact;
    damaged[place + at] = static_cast<char>(damaged[place + at] ^ 0x80);
    write_bytes(path, damaged);
    seal_archive(path, path);
    return error_of([&] { Archive(path).load_all(); });
  };
  const PackedRows& packed = dynamic_cast<const HaarFamily&>(*model.h).packed();
  REQUIRE(packed.format() == PackedFormat::single);
  std::vector<std::int32_t> table;
  for (std::size_t r = 0; r < packed.rows(); ++r)
    for (std::size_t n : {packed.entries(r), packed.gap_bytes(r)})
      table.push_back(static_cast<std::int32_t>(n));
  const std::string rows(reinterpret_cast<const char*>(table.data()), 4 * table.size());
  const std::string gaps(packed.gaps().begin(), packed.gaps().end());
  for (const auto& [code, message] :
       {refusal(gaps, 5), refusal(rows, 3), refusal(rows, 8), refusal(rows, 12)}) {
    CHECK(code == 4);
    CHECK(message.find("/matrices/h") != std::string::npos);
  }
}

TEST_CASE("Energies come back from an archive, which is valid without them") {
  const test::TemporaryFolder folder("energies");
  const std::string codec = GENERATE("none", "haar", "lowrank");
  const BodyModel model = energetic_model(CodecOptions(codec_named(codec)));
  write_archive(folder / "a.bem", model, provenance(), false);
  const Archive archive(folder / "a.bem");
  CHECK(archive.has_energies());
  CHECK_NOTHROW(archive.check_matrices());
  const BodyModel back = archive.load_motion_matrices();
  REQUIRE(back.has_energies());
  check_same(*model.energy_stiffness, *back.energy_stiffness);
  check_same(*model.energy_mass, *back.energy_mass);
  const std::vector<std::string> paths = archive.matrix_paths();
  for (const char* name : {"stiffness", "mass"})
    CHECK(std::count(paths.begin(), paths.end(),
                     "/matrices/energy_" + std::string(name) + "/real") == 1);

  write_archive(folder / "b.bem", small_model(), provenance(), false);
  const Archive without(folder / "b.bem");
  CHECK_FALSE(without.has_energies());
  CHECK_FALSE(without.load_all().has_energies());
}

TEST_CASE("What a codec stores has the energies of smooth motions to 1e-4") {
  const std::string codec = GENERATE("none", "haar", "lowrank");
  const BodyModel exact = energetic_model(CodecOptions(codec_named("none", Precision::float64))),
                  model = energetic_model(CodecOptions(codec_named(codec)));
  const auto n = static_cast<Eigen::Index>(3 * model.nodes());
  Eigen::VectorXd stretched(n);
  for (Eigen::Index i = 0; i < n; i += 3) {
    const Vec3& x = model.geometry.nodes.vertices[static_cast<std::size_t>(i / 3)];
    stretched.segment<3>(i) = Vec3(x[0], -0.3 * x[1], 0.1 * x[0]);
  }
  const auto energy = [&](const MatrixFamily& family) {
    return stretched.dot(full_matrix(family, 0) * stretched);
  };
  CHECK(energy(*model.energy_stiffness) == Approx(energy(*exact.energy_stiffness)).epsilon(1e-4));
  CHECK(energy(*model.energy_mass) == Approx(energy(*exact.energy_mass)).epsilon(1e-4));
  const Vec3 back(1, 2, 3);
  CHECK((full_matrix(*model.energy_stiffness, 0) * back.replicate(n / 3, 1)).norm() <
        1e-4 * full_matrix(*model.energy_stiffness, 0).norm());
}

TEST_CASE("Parts of an archive are those of the whole") {
  const test::TemporaryFolder folder("parts");
  const Precision precision = GENERATE(Precision::float32, Precision::float64);
  const BodyModel model = small_model("radau2", CodecOptions(codec_named("none", precision)));
  write_archive(folder / "a.bem", model, provenance(), false);
  const Archive archive(folder / "a.bem");
  CHECK(archive.unknowns() == 126);

  const BodyModel motion = archive.load_motion_matrices();
  check_small_parts(model, motion);
  check_motion(model, motion);
  CHECK(!motion.g);
  CHECK(motion.traction_response.empty());

  for (const std::vector<int>& nodes : {std::vector<int>{0, 5, 41}, std::vector<int>{}}) {
    const TractionData part = archive.load_tractions(nodes);
    const TractionData expected = extract_tractions(model, nodes);
    CHECK(part.nodes == nodes);
    const std::vector<int> columns = unknowns_of(nodes);
    const auto entries = [&](const MatrixFamily& family, int k) {
      return family.block(k, rows_of(family), columns);
    };
    REQUIRE(part.lags->count() == expected.lags->count());
    for (int k = 0; k < part.lags->count(); ++k)
      CHECK(entries(*part.lags, k) == entries(*expected.lags, k));
    for (std::size_t i = 0; i < part.initial.size(); ++i)
      CHECK(entries(*part.initial[i], 0) == entries(*expected.initial[i], 0));
  }
  CHECK_THROWS_AS(archive.load_tractions({42}), Error);
  CHECK_THROWS_AS(archive.load_tractions({-1}), Error);

  std::vector<double> rows(2 * 126);
  archive.read_matrix_rows("/matrices/h/lag_002/component_1", 5, 2, rows.data());
  const Eigen::MatrixXd column = model.h->block(model.lag_index(2, 1), {5, 6}, {3});
  CHECK(rows[3] == column(0, 0));
  CHECK(rows[126 + 3] == column(1, 0));
}

TEST_CASE("Loading reports its progress and can be stopped by it") {
  const test::TemporaryFolder folder("load_progress");
  write_archive(folder / "a.bem", small_model("bdf1"), provenance(), false);
  const Archive archive(folder / "a.bem");
  double last = 0;
  bool ordered = true;
  const auto watch = [&](const std::string&, double fraction) {
    ordered = ordered && fraction >= last;
    last = fraction;
  };
  archive.load_motion_matrices(watch);
  CHECK(last == 1);
  last = 0;
  archive.load_tractions({0}, watch);
  CHECK(last == 1);
  last = 0;
  archive.load_all(watch);
  CHECK(last == 1);
  CHECK(ordered);
  struct Stop {};
  CHECK_THROWS_AS(archive.load_all([](const std::string&, double) { throw Stop{}; }), Stop);
}

TEST_CASE("A sealed file that is not what this version understands is refused") {
  const test::TemporaryFolder folder("foreign_contents");
  const BodyModel model = small_model("bdf1");
  Hdf5CreateOptions options;
  options.user_block = kUserBlock;
  const auto refusal = [&](const std::string& model_name, const std::string& codec) {
    Hdf5File file = Hdf5File::create(folder / "a.bem", options);
    file.set_attribute("/", "format", "bem matrix archive");
    file.set_attribute("/", "format_version", kArchiveVersion);
    file.set_attribute("/", "model", model_name);
    file.set_attribute("/", "codec", codec);
    file.set_attribute("/", "precision", "float32");
    file.close();
    seal_archive(folder / "a.bem", "a.bem");
    return error_of([&] { Archive(folder / "a.bem"); });
  };
  CHECK(refusal("plastic", "none").second.find("model \"plastic\"") != std::string::npos);
  CHECK(refusal("dynamic", "zip").second.find("codec \"zip\"") != std::string::npos);
  const auto [code, message] = refusal("dynamic", "none");
  CHECK(code == 4);
  CHECK(message.find("/mesh/vertices") != std::string::npos);
}
