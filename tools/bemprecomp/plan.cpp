#include "plan.hpp"

#include "algebra/lu.hpp"
#include "archive/archive_writer.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "common/cli.hpp"
#include "compress/dense_store.hpp"
#include "mesh/mesh_io.hpp"
#include "model/memory_estimate.hpp"
#include "model/model_assembly.hpp"
#include "scene/named_materials.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace bem {
namespace {

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Per row; with short time steps that of longer ones, times what lags and points of the
/// quadrature grow by.
double seconds_of_some_rows(const Plan& plan) {
  constexpr double kShort = 60;  // traversal steps
  PrecomputeOptions options = plan.body.options;
  Discretisation& d = options.discretisation;
  const double factor = std::max(1.0, plan.body.lam / kShort);
  d.dt *= factor;
  d.history_length = static_cast<int>(std::ceil(d.history_length / factor));
  return seconds_per_row(plan.body.geometry, options) * std::pow(factor, 3);
}

/// Sizes of a dry run: by compressing a sample, or without compression if that takes too long.
StoredEstimate estimate_compression(Plan& plan) {
  constexpr double kSampledNodes = 384, kTooLong = 60;  // seconds
  constexpr double kWithCompression = 1.5;              // of the time without
  const auto nodes = static_cast<double>(plan.body.geometry.nodes.vertices.size());
  const double row = seconds_of_some_rows(plan);
  if (row * std::min(nodes, kSampledNodes) < kTooLong)
    return estimate_stored(plan.body.geometry, plan.body.options);
  plan.uncompressed = true;
  PrecomputeOptions none = plan.body.options;
  none.codec = CodecOptions();
  StoredEstimate out = estimate_stored(plan.body.geometry, none);
  out.assembly_bytes = out.bytes;
  out.assembly_seconds = kWithCompression * row * nodes;
  return out;
}

void estimate_bytes(bool sample, Plan& plan) {
  StoredEstimate stored;
  const bool compressed = plan.body.options.codec.codec->is_sampled();
  if (!compressed || sample) {
    stored = compressed ? estimate_compression(plan)
                        : estimate_stored(plan.body.geometry, plan.body.options);
    plan.stored = stored.bytes;
    plan.compression_seconds = stored.assembly_seconds;
  }
  plan.peak = peak_bytes(plan.body.geometry, plan.body.options, stored);
  plan.archive_bytes = archive_bytes(plan.body.geometry, plan.body.options, plan.stored);
}

/// Factorisation, inverse and, if asked for, solution for n right-hand sides, for one initial
/// component.
template <class T>
double seconds_of_inversion(double unknowns, bool solution) {
  const auto n = static_cast<Eigen::Index>(std::min(unknowns, 768.0));
  DenseMatrix<T> a = DenseMatrix<T>::Random(n, n), b = DenseMatrix<T>::Random(n, n);
  a.diagonal().array() += T(static_cast<double>(n));
  const double seconds = seconds_of([&] {
    Lu<T> lu(std::move(a));
    if (solution) lu.solve(b);
    a = std::move(lu).invert();
  });
  return seconds * std::pow(unknowns / static_cast<double>(n), 3);
}

double seconds_per_byte_of_products() {
  constexpr std::size_t kSize = 4096;
  DenseStore<float> matrix(kSize, kSize);
  parallel_for(kSize, [&](std::size_t i) { std::fill_n(matrix.row(i), kSize, 1.0f); });
  const std::vector<double> x(kSize, 1.0);
  std::vector<double> y(kSize, 0.0);
  matrix.multiply_add(x.data(), y.data(), 1);
  return seconds_of([&] { matrix.multiply_add(x.data(), y.data(), 1); }) /
         static_cast<double>(matrix.bytes());
}

}  // namespace

Plan make_plan(const Options& o) {
  Plan plan;
  plan.inputs.mesh = o.mesh;
  plan.inputs.mesh_scale = o.mesh_scale;
  plan.inputs.material = find_material(o.material);
  plan.inputs.material_name = o.material;
  plan.inputs.settings = o.settings;
  plan.body = plan_body(simulated_mesh(read_mesh(o.mesh), plan.inputs, SettingStyle::option),
                        plan.inputs, SettingStyle::option);
  if (o.settings.model == ModelKind::rigid)
    plan.archive_bytes = archive_bytes(plan.body.geometry, plan.body.options, 0);
  else
    estimate_bytes(o.dry_run, plan);
  return plan;
}

void check_memory(const Plan& plan) {
  const auto available = static_cast<double>(physical_memory());
  if (plan.peak <= available) return;
  throw Error(
      ErrorCode::resources,
      "not enough memory: " + bytes_text(plan.peak) + " are needed for " +
          std::to_string(plan.body.geometry.nodes.vertices.size()) + " nodes and a history of " +
          std::to_string(plan.body.options.discretisation.history_length) +
          " steps, but the machine has " + bytes_text(available) +
          "; use --codec lowrank, --inverse iterative, a coarser mesh, a larger --dt or a shorter "
          "--history");
}

TimeEstimate estimate_time(const Plan& plan) {
  if (plan.body.options.kind == ModelKind::rigid) return {};
  constexpr double kGrowthSteps = 150, kWriteSpeed = 1e9;
  const Discretisation& d = plan.body.options.discretisation;
  const auto nodes = static_cast<double>(plan.body.geometry.nodes.vertices.size());
  const bool compressed = plan.body.options.codec.codec->is_sampled();
  const bool dense = plan.body.options.inverse == InverseKind::dense;
  TimeEstimate t;
  t.assembly = compressed ? plan.compression_seconds : nodes * seconds_of_some_rows(plan);
  for (const InitialComponent& c : d.scheme.initial_components())
    if (dense)
      t.inversion += c.paired ? seconds_of_inversion<Complex>(3 * nodes, !compressed)
                              : seconds_of_inversion<double>(3 * nodes, !compressed);
  // a step reads the H_k, about half of what is stored; iterative ones H_0 many times
  constexpr double kIterations = 30;
  const double lags = static_cast<double>(d.history_length * d.scheme.lag_components().size());
  const double reads = 0.5 * (dense ? 1 : 1 + kIterations / lags);
  if (lags > 0 && plan.body.options.measure_growth)
    t.growth =
        (kGrowthSteps + d.history_length) * plan.stored * reads * seconds_per_byte_of_products();
  t.writing = plan.archive_bytes / kWriteSpeed;
  return t;
}

}  // namespace bem
