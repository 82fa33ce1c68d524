#include "preparation/body_plan.hpp"

#include "base/error.hpp"
#include "mesh/describe.hpp"
#include "mesh/extent.hpp"
#include "mesh/mesh_io.hpp"
#include "mesh/solids.hpp"
#include "model/defaults.hpp"
#include "model/energy_matrices.hpp"
#include "model/memory_estimate.hpp"
#include "preparation/time_step.hpp"
#include "repair/repair.hpp"
#include "scene/groups.hpp"
#include "scene/selection.hpp"
#include "scene/selection_json.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace bem {
namespace {

Surface surface_of(TriangleMesh mesh, const BodyInputs& inputs) {
  for (Vec3& v : mesh.vertices) v *= inputs.mesh_scale;
  Surface surface = make_surface(std::move(mesh), inputs.mesh);
  check_single_solid(surface, inputs.mesh);
  return surface;
}

/// The steps of plan_body().
class Planner {
 public:
  Planner(const BodyInputs& inputs, SettingStyle style) : inputs_(inputs), style_(style) {
    plan_.settings = inputs.settings;
  }

  BodyPlan run(SimulatedMesh mesh) {
    PrecomputeOptions& options = plan_.options;
    options.kind = settings().model;
    options.discretisation.material = inputs_.material;
    make_body(std::move(mesh));
    if (options.kind == ModelKind::rigid) return std::move(plan_);
    choose_discretisation();
    choose_storage();
    if (options.kind == ModelKind::dynamic)
      choose_history();
    else
      options.discretisation.dt = quasistatic_time_step(plan_.geometry, inputs_.material);
    count_points();
    return std::move(plan_);
  }

 private:
  const PrecomputeSettings& settings() const { return plan_.settings; }
  std::string name(const char* setting) const { return setting_name(style_, setting); }
  std::string text(const char* setting, const std::string& value) const {
    return setting_text(style_, setting, value);
  }
  /// The time step as its reader knows it.
  std::string time_step_name() const {
    return style_ == SettingStyle::option ? "--dt" : "\"time_step\"";
  }

  /// Nobody has said how long it is.
  bool is_step_automatic() const {
    return inputs_.automatic_time_step || !(settings().time_step || inputs_.material.time_step);
  }
  /// `text` where the time step is given, so that another one may be.
  std::string if_given(const std::string& text) const { return is_step_automatic() ? "" : text; }

  void make_body(SimulatedMesh mesh);
  void tell_large_body();
  void settle_method(const Surface& surface);
  void choose_discretisation();
  void choose_storage();
  void check_energies() const;
  void load(const std::vector<Selection>& selections);
  std::vector<Selection> read_load_file() const;
  double time_step();
  void choose_history();
  void count_points();
  double history_length() const;
  void check_history();

  const BodyInputs& inputs_;
  SettingStyle style_;
  BodyPlan plan_;
};

void Planner::make_body(SimulatedMesh mesh) {
  const Surface surface = surface_of(std::move(mesh.mesh), inputs_);
  plan_.warnings = std::move(mesh.warnings);
  plan_.notes = std::move(mesh.notes);
  plan_.warnings.insert(plan_.warnings.end(), surface.warnings.begin(), surface.warnings.end());
  if (mesh.changed) plan_.repair = settings().repair_text(inputs_.repair);
  if (settings().model != ModelKind::rigid) settle_method(surface);
  plan_.geometry = make_geometry(surface, inputs_.material.density);
  plan_.geometry.corner_angle_deg = settings().corner_angle();
  tell_large_body();
  constexpr std::size_t kMany = 20000;
  const std::size_t nodes = plan_.geometry.nodes.vertices.size();
  if (nodes > kMany && settings().model != ModelKind::rigid)
    plan_.warnings.push_back(inputs_.mesh + ": " + std::to_string(nodes) +
                             " vertices take hours and much memory; " + name("nodes") +
                             " simulates a coarser surface that moves the mesh");
}

/// Modelling programs write millimetres, and files do not say so.
void Planner::tell_large_body() {
  constexpr double kLarge = 10;  // [m]
  if (inputs_.mesh_scale != 1 || plan_.geometry.extent < kLarge) return;
  plan_.notes.push_back(inputs_.mesh + ": the body is " + rounded_text(plan_.geometry.extent, 3) +
                        " m large; a mesh in millimetres needs " + name("mesh-scale") +
                        (style_ == SettingStyle::option ? " 0.001" : ": 0.001"));
}

void Planner::settle_method(const Surface& surface) {
  const SpatialMethod method = default_method(surface);
  if (settings().method_or_default() != SpatialMethod::galerkin ||
      method == SpatialMethod::galerkin)
    return;
  const std::string galerkin = text("discretisation", "galerkin"),
                    collocation = text("discretisation", "collocation");
  if (settings().energies)
    throw Error(ErrorCode::invalid_input,
                inputs_.mesh + ": the body has a cavity inside, for which there is no " + galerkin +
                    " and there are no energies: leave " + name("energies") +
                    " away, or fill the cavity");
  if (settings().method)
    throw Error(ErrorCode::invalid_input,
                inputs_.mesh + ": the body has a cavity inside, whose place " + galerkin +
                    " does not determine: use " + collocation + ", or fill the cavity");
  plan_.settings.method = method;
  plan_.warnings.push_back(inputs_.mesh + ": the body has a cavity inside, so that " + collocation +
                           " is used instead of galerkin");
}

void Planner::choose_discretisation() {
  Discretisation& d = plan_.options.discretisation;
  d.scheme = Scheme::parse(settings().scheme_name());
  d.method = settings().method_or_default();
  d.quadrature_tolerance = settings().quadrature_tolerance;
  d.damping = settings().damping;
  plan_.options.window = settings().window;
  plan_.options.energies = settings().energies;
  plan_.options.measure_growth = !d.is_galerkin() || settings().measure_growth;
}

void Planner::choose_storage() {
  PrecomputeOptions& options = plan_.options;
  options.codec = settings().codec_options();
  options.inverse = settings().inverse.value_or(default_inverse(plan_.geometry, options.kind));
  check_energies();
  if (settings().loads == "none")
    options.loads = Loads::none;
  else if (settings().has_load_file())
    load(read_load_file());
  else if (!inputs_.loaded.empty())
    load(inputs_.loaded);
}

void Planner::check_energies() const {
  if (!plan_.options.energies) return;
  if (plan_.options.inverse != InverseKind::dense)
    throw Error(ErrorCode::invalid_input,
                inputs_.mesh + ": " + count_text(plan_.geometry.nodes.vertices.size(), "node") +
                    " are too many for " + name("energies") + ", which take a dense inverse: use " +
                    text("inverse", "dense") + ", or a coarser mesh (" + name("nodes") + ")");
  const double nu = inputs_.material.poisson_ratio;
  if (nu > kMostPoissonRatioOfEnergies)
    throw Error(ErrorCode::invalid_input, inputs_.material_name + ": a Poisson ratio of " +
                                              to_text(nu) + " is too large for " +
                                              name("energies") + ": use at most " +
                                              to_text(kMostPoissonRatioOfEnergies) + ", or leave " +
                                              name("energies") + " away");
}

std::vector<Selection> Planner::read_load_file() const {
  std::vector<Selection> selections = read_selections(settings().loads);
  const Groups groups(read_mesh_groups(inputs_.mesh));
  for (Selection& s : selections) groups.resolve(s);
  return selections;
}

/// Some vertices may carry loads.
void Planner::load(const std::vector<Selection>& selections) {
  std::set<int> nodes;
  for (const Selection& s : selections)
    for (int node : select_nodes(plan_.geometry, s)) nodes.insert(node);
  plan_.options.loads = Loads::some;
  plan_.options.loaded_nodes.assign(nodes.begin(), nodes.end());
}

double Planner::time_step() {
  if (settings().time_step) return *settings().time_step;
  if (inputs_.material.time_step) return *inputs_.material.time_step;
  const AutomaticTimeStep step =
      automatic_time_step({crossing_time(plan_.geometry.extent, inputs_.material)});
  plan_.notes.push_back(
      "no time step is given: " + to_text(step.seconds) + " s" + step.reason +
      "; a scene with this archive needs \"time_step\": " + to_text(step.seconds) + " or \"auto\"");
  return step.seconds;
}

double Planner::history_length() const {
  const Discretisation& d = plan_.options.discretisation;
  if (settings().history) return *settings().history;
  const auto& tolerance = settings().history_tolerance;
  return damped_history_length(plan_.lam, d.damping.time / d.dt) +
         (tolerance ? history_length_for_tolerance(d.scheme, plan_.lam, *tolerance)
                    : default_history_length(d.scheme, plan_.lam));
}

void Planner::choose_history() {
  constexpr double kMostTraversalSteps = 20000, kLongestHistory = 100000;
  Discretisation& d = plan_.options.discretisation;
  d.dt = time_step();
  plan_.lam = traversal_steps(plan_.geometry, d.material, d.dt);
  if (!(plan_.lam <= kMostTraversalSteps))
    throw Error(
        ErrorCode::usage,
        "the time step " + to_text(d.dt) + " s is too small: a shear wave takes " +
            to_text(std::round(plan_.lam)) + " steps across the body; use " +
            (is_step_automatic() ? "fewer frames per second" : "a larger " + time_step_name()));
  const double length = history_length();
  if (!(length <= kLongestHistory))
    throw Error(ErrorCode::usage, "the history would be " + to_text(std::round(length)) +
                                      " steps long; use " +
                                      if_given("a larger " + time_step_name() + " or ") +
                                      "a smaller " + name("damping"));
  d.history_length = static_cast<int>(length);
  check_history();
}

void Planner::check_history() {
  constexpr int kLongHistory = 60;
  const Discretisation& d = plan_.options.discretisation;
  const std::string crossing = to_text(std::round(plan_.lam));
  if (is_too_short(d.history_length, plan_.lam))
    throw Error(ErrorCode::usage, name("history") + " " + std::to_string(d.history_length) +
                                      " is too short: a shear wave takes " + crossing +
                                      " steps across the body; leave it away" +
                                      if_given(" or use a larger " + time_step_name()));
  if (d.is_galerkin() && d.history_length < std::floor(plan_.lam + 2))
    plan_.warnings.push_back("the history of " + std::to_string(d.history_length) +
                             " steps is shorter than the " + crossing +
                             " steps that a shear wave takes across the body: motions may grow");
  if (d.history_length > kLongHistory)
    plan_.warnings.push_back("the history is long: " + std::to_string(d.history_length) +
                             " steps; memory and time grow with it" +
                             if_given(" (a larger " + time_step_name() + " makes it shorter)"));
}

/// Triangles that are close to each other, as in thin walls and slits, take the more points of the
/// quadrature the longer they are beside the distance.
void Planner::count_points() {
  constexpr double kUsual = 3e4, kMany = 10;  // points of a triangle, times as many
  const bool galerkin = plan_.options.discretisation.is_galerkin();
  plan_.quadrature = count_quadrature(plan_.geometry.nodes, plan_.options.discretisation);
  const double times = plan_.quadrature.near_points /
                       (kUsual * static_cast<double>(plan_.geometry.nodes.triangles.size()));
  if (!galerkin || times < kMany) return;
  plan_.warnings.push_back(
      inputs_.mesh +
      ": parts of the surface are so close to each other, as in thin walls and "
      "slits, that the quadrature takes at least " +
      rounded_text(times, 2) +
      " times as long as usual; triangles as short as the walls are thick, or "
      "thicker walls, cure that");
}

}  // namespace

SimulatedMesh simulated_mesh(const TriangleMesh& file, const BodyInputs& inputs,
                             SettingStyle style) {
  RepairOptions options = inputs.settings.repair_options(inputs.repair);
  options.unit = inputs.mesh_scale;
  SimulatedMesh out;
  if (options.mode == RepairMode::off) {
    try {
      check_single_solid(make_surface(file, inputs.mesh), inputs.mesh);
    } catch (const Error& e) {
      throw Error(e.code(), std::string(e.what()) + "; " + setting_text(style, "repair", "auto") +
                                " would mend it");
    }
    if (!options.nodes) {
      out.mesh = file;
      return out;
    }
  }
  RepairedMesh repaired = repair_mesh(file, options, inputs.mesh);
  out.mesh = std::move(repaired.mesh);
  out.changed = repaired.report.changed;
  const RepairReport& report = repaired.report;
  const bool coarse = report.sheet || report.wrapped || report.other_volume;
  for (const std::string& step : repaired.report.steps)
    (coarse ? out.warnings : out.notes).push_back(inputs.mesh + ": " + step);
  return out;
}

BodyPlan plan_body(SimulatedMesh mesh, const BodyInputs& inputs, SettingStyle style) {
  return Planner(inputs, style).run(std::move(mesh));
}

void check_memory(const BodyPlan& plan, double available, SettingStyle style) {
  const double least =
      peak_bytes(plan.geometry, plan.options, certain_bytes(plan.geometry, plan.options));
  if (least <= available) return;
  throw Error(ErrorCode::resources,
              "not enough memory: at least " + bytes_text(least) + " are needed for " +
                  count_text(plan.geometry.nodes.vertices.size(), "node") + " and a history of " +
                  count_text(plan.options.discretisation.history_length, "step") +
                  ", but there are " + bytes_text(available) + "; use " +
                  setting_text(style, "codec", "lowrank") + ", " +
                  setting_text(style, "inverse", "iterative") + ", a coarser mesh (" +
                  setting_name(style, "nodes") + ") or a larger time step");
}

double crossing_time(const SimulatedMesh& mesh, const BodyInputs& inputs) {
  return crossing_time(inputs.mesh_scale * diameter(mesh.mesh.vertices), inputs.material);
}

Provenance provenance_of(const BodyInputs& inputs, const BodyPlan& plan,
                         const std::string& program) {
  const auto file_name = [](const std::string& path) {
    return std::filesystem::path(path).filename().string();
  };
  return {program, file_name(inputs.mesh), file_name(inputs.material_name), inputs.mesh_scale,
          plan.settings.canonical_text() + plan.repair};
}

}  // namespace bem
