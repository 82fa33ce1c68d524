#include "plan.hpp"

#include "algebra/lu.hpp"
#include "archive/archive_writer.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "common/cli.hpp"
#include "compress/dense_store.hpp"
#include "mesh/describe.hpp"
#include "mesh/mesh_io.hpp"
#include "mesh/solids.hpp"
#include "model/defaults.hpp"
#include "model/model_assembly.hpp"
#include "scene/groups.hpp"
#include "scene/named_materials.hpp"
#include "scene/selection.hpp"
#include "scene/selection_json.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

namespace bem {
namespace {

constexpr double kMostTraversalSteps = 20000;
constexpr int kLongHistory = 60;
constexpr double kLongestHistory = 100000;

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void settle_method(const Surface& surface, Options& o, std::vector<std::string>& warnings) {
  if (o.model == ModelKind::rigid || o.method != SpatialMethod::galerkin ||
      default_method(surface) == SpatialMethod::galerkin)
    return;
  if (o.method_given)
    throw Error(ErrorCode::invalid_input,
                o.mesh +
                    ": the body has a cavity inside, whose place --discretisation galerkin does "
                    "not determine: use --discretisation collocation, or fill the cavity");
  o.use_collocation();
  warnings.push_back(o.mesh +
                     ": the body has a cavity inside, so that --discretisation collocation is used "
                     "instead of galerkin");
}

BodyGeometry read_body(Options& o, double density, std::vector<std::string>& warnings) {
  TriangleMesh mesh = read_mesh(o.mesh);
  if (o.mesh_scale != 1)
    for (Vec3& v : mesh.vertices) v *= o.mesh_scale;
  Surface surface = make_surface(std::move(mesh), o.mesh);
  check_single_solid(surface, o.mesh);
  warnings = surface.warnings;
  settle_method(surface, o, warnings);
  BodyGeometry geometry = make_geometry(surface, density);
  geometry.corner_angle_deg = o.corner_angle_deg;
  return geometry;
}

/// Nodes that a file of selections chooses.
std::vector<int> read_loaded_nodes(const std::string& path, const std::string& mesh,
                                   const BodyGeometry& geometry) {
  const Groups groups(read_mesh_groups(mesh));
  std::set<int> nodes;
  for (Selection& s : read_selections(path)) {
    groups.resolve(s);
    for (int node : select_nodes(geometry, s)) nodes.insert(node);
  }
  return {nodes.begin(), nodes.end()};
}

void plan_storage(const Options& o, Plan& plan) {
  PrecomputeOptions& p = plan.options;
  p.codec = o.codec;
  p.inverse = o.inverse.value_or(default_inverse(plan.geometry, o.model));
  if (o.loads == "none") {
    p.loads = Loads::none;
  } else if (o.loads != "all") {
    p.loads = Loads::some;
    p.loaded_nodes = read_loaded_nodes(o.loads, o.mesh, plan.geometry);
  }
}

/// Per row; with short time steps that of longer ones, times what lags and points of the
/// quadrature grow by.
double seconds_of_some_rows(const Plan& plan) {
  constexpr double kShort = 60;  // traversal steps
  PrecomputeOptions options = plan.options;
  Discretisation& d = options.discretisation;
  const double factor = std::max(1.0, plan.lam / kShort);
  d.dt *= factor;
  d.history_length = static_cast<int>(std::ceil(d.history_length / factor));
  return seconds_per_row(plan.geometry, options) * std::pow(factor, 3);
}

/// Sizes of a dry run: by compressing a sample, or without compression if that takes too long.
StoredEstimate estimate_compression(Plan& plan) {
  constexpr double kSampledNodes = 384, kTooLong = 60;  // seconds
  constexpr double kWithCompression = 1.5;              // of the time without
  const auto nodes = static_cast<double>(plan.geometry.nodes.vertices.size());
  const double row = seconds_of_some_rows(plan);
  if (row * std::min(nodes, kSampledNodes) < kTooLong)
    return estimate_stored(plan.geometry, plan.options);
  plan.uncompressed = true;
  PrecomputeOptions none = plan.options;
  none.codec = CodecOptions();
  StoredEstimate out = estimate_stored(plan.geometry, none);
  out.assembly_bytes = out.bytes;
  out.assembly_seconds = kWithCompression * row * nodes;
  return out;
}

void estimate_bytes(bool sample, Plan& plan) {
  StoredEstimate stored;
  const bool compressed = plan.options.codec.codec->is_sampled();
  if (!compressed || sample) {
    stored = compressed ? estimate_compression(plan) : estimate_stored(plan.geometry, plan.options);
    plan.stored = stored.bytes;
    plan.compression_seconds = stored.assembly_seconds;
  }
  plan.peak = peak_bytes(plan.geometry, plan.options, stored);
  plan.archive_bytes = archive_bytes(plan.geometry, plan.options, plan.stored);
}

double history_length(const Options& o, const Discretisation& d, double lam) {
  if (o.history) return *o.history;
  return damped_history_length(lam, d.damping.time / d.dt) +
         (o.history_tolerance ? history_length_for_tolerance(d.scheme, lam, *o.history_tolerance)
                              : default_history_length(d.scheme, lam));
}

double time_step(const Options& o, const Material& material) {
  if (!o.dt && !material.time_step)
    throw Error(ErrorCode::usage, "no time step: give --dt S, or \"time_step\" in " + o.material);
  return o.dt ? *o.dt : *material.time_step;
}

void plan_history(const Options& o, Plan& plan) {
  Discretisation& d = plan.options.discretisation;
  plan.lam = traversal_steps(plan.geometry, d.material, d.dt);
  if (!(plan.lam <= kMostTraversalSteps))
    throw Error(ErrorCode::usage,
                "the time step " + to_text(d.dt) + " s is too small: a shear wave takes " +
                    to_text(std::round(plan.lam)) + " steps across the body; use a larger --dt");
  const double length = history_length(o, d, plan.lam);
  if (!(length <= kLongestHistory))
    throw Error(ErrorCode::usage, "the history would be " + to_text(std::round(length)) +
                                      " steps long; use a larger --dt or a smaller --damping");
  d.history_length = static_cast<int>(length);
  if (is_too_short(d.history_length, plan.lam))
    throw Error(ErrorCode::usage, "--history " + std::to_string(d.history_length) +
                                      " is too short: a shear wave takes " +
                                      to_text(std::round(plan.lam)) +
                                      " steps across the body; leave it away or use a larger --dt");
  if (d.is_galerkin() && d.history_length < std::floor(plan.lam + 2))
    plan.warnings.push_back("the history of " + std::to_string(d.history_length) +
                            " steps is shorter than the " + to_text(std::round(plan.lam)) +
                            " steps that a shear wave takes across the body: motions may grow");
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

Plan make_plan(Options& o) {
  Plan plan;
  Discretisation& d = plan.options.discretisation;
  d.material = find_material(o.material);
  plan.options.kind = o.model;
  if (o.model == ModelKind::rigid) {
    plan.geometry = read_body(o, d.material.density, plan.warnings);
    plan.archive_bytes = archive_bytes(plan.geometry, plan.options, 0);
    return plan;
  }
  d.scheme = Scheme::parse(o.scheme);
  d.quadrature_tolerance = o.quadrature_tolerance;
  d.damping = o.damping;
  plan.options.window = o.window;
  if (o.model == ModelKind::dynamic) d.dt = time_step(o, d.material);
  plan.geometry = read_body(o, d.material.density, plan.warnings);
  d.method = o.method;
  plan.options.measure_growth = !d.is_galerkin() || o.measure_growth;
  plan_storage(o, plan);
  if (o.model == ModelKind::dynamic)
    plan_history(o, plan);
  else
    d.dt = quasistatic_time_step(plan.geometry, d.material);
  estimate_bytes(o.dry_run, plan);
  if (d.history_length > kLongHistory)
    plan.warnings.push_back(
        "the history is long: " + std::to_string(d.history_length) +
        " steps; memory and time grow with it (a larger --dt makes it shorter)");
  return plan;
}

void check_memory(const Plan& plan) {
  const auto available = static_cast<double>(physical_memory());
  if (plan.peak <= available) return;
  throw Error(
      ErrorCode::resources,
      "not enough memory: " + bytes_text(plan.peak) + " are needed for " +
          std::to_string(plan.geometry.nodes.vertices.size()) + " nodes and a history of " +
          std::to_string(plan.options.discretisation.history_length) +
          " steps, but the machine has " + bytes_text(available) +
          "; use --codec lowrank, --inverse iterative, a coarser mesh, a larger --dt or a shorter "
          "--history");
}

TimeEstimate estimate_time(const Plan& plan) {
  if (plan.options.kind == ModelKind::rigid) return {};
  constexpr double kGrowthSteps = 150, kWriteSpeed = 1e9;
  const Discretisation& d = plan.options.discretisation;
  const auto nodes = static_cast<double>(plan.geometry.nodes.vertices.size());
  const bool compressed = plan.options.codec.codec->is_sampled();
  const bool dense = plan.options.inverse == InverseKind::dense;
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
  if (lags > 0 && plan.options.measure_growth)
    t.growth =
        (kGrowthSteps + d.history_length) * plan.stored * reads * seconds_per_byte_of_products();
  t.writing = plan.archive_bytes / kWriteSpeed;
  return t;
}

}  // namespace bem
