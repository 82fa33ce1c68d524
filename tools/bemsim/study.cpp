#include "study.hpp"

#include "base/error.hpp"
#include "common/measure.hpp"
#include "common/version.hpp"
#include "mesh/describe.hpp"
#include "scene/selection.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace bem {
namespace {

void refuse_what_has_one_mesh(const Scene& scene) {
  if (scene.initial_state)
    throw error_at(scene.initial_state->location,
                   "--convergence compares runs with other meshes and time steps, which cannot "
                   "start from a state of this one");
  for (const BodySpec& body : scene.bodies) {
    if (!body.source || !body.archive.resolved.empty())
      throw error_at(body.archive.location,
                     "--convergence makes other meshes of the body " + in_quotes(body.name) +
                         ": give it \"mesh\" and \"material\" without an \"archive\"");
    const Selection* numbers = selection_by_numbers(body);
    if (numbers && body.source->settings.model != ModelKind::rigid)
      throw error_at(numbers->location,
                     "--convergence makes other meshes of the body, in which vertices and "
                     "triangles, and groups of them, have no numbers; select by a box, sphere or "
                     "plane");
  }
}

/// What matrices of a level cost over those of the scene, about, by what they are seen to cost.
double cost_of_matrices(const StudyLevel& level) {
  return std::exp2(1.6 * level.mesh) * (0.6 + 0.4 * std::exp2(level.time));
}

}  // namespace

Study::Study(const Options& options, const Scene& scene, Listener listener)
    : options_(options), scene_(scene), cache_(cache_of(options)), listener_(std::move(listener)) {
  refuse_what_has_one_mesh(scene);
  scene_.output.surface = OutputSurface::simulation;
  for (BodySpec& body : scene_.bodies) body.render_mesh.reset();
  points_ = followed_points(scene_);
}

StudyReport Study::run() {
  run_scene();
  announce();
  for (std::size_t k = 1; k < levels_.size(); ++k) run_level(levels_[k]);
  StudyResult result = evaluate_study(runs_, expected_time_order(scene_));
  return {version_text(), scene_, times_, runs_, costs_, std::move(result)};
}

void Study::run_scene() {
  Scene scene = scene_;
  ArchiveSource source(listener_.progress);
  prepare(scene, source, {}, MissingArchives::compute);
  scene_.time_step = scene.time_step;
  choose_levels(scene, source);
  simulate(std::move(scene), source, {});
}

long Study::every() const {
  if (options_.fps) return std::max(1L, std::lround(1 / (*options_.fps * scene_.time_step)));
  return options_.every.value_or(scene_.output.every);
}

/// "208 nodes and a time step of 0.005 s".
std::string Study::label(const StudyLevel& level) const {
  std::size_t nodes = 0;
  for (std::size_t b = 0; b < nodes_.size(); ++b) nodes += nodes_at(level, nodes_[b]);
  return "about " + count_text(nodes, "node") + " and a time step of " +
         to_text(std::ldexp(scene_.time_step, -level.time)) + " s";
}

/// Names the run, if it is not the scene's own.
void Study::tell_once(const StudyLevel& level, const std::string& warning) {
  if (!told_.insert(warning).second) return;
  const bool own = level.mesh == 0 && level.time == 0;
  listener_.warn(own ? warning : "the run with " + label(level) + ": " + warning);
}

/// Returns how many archives are missing.
std::size_t Study::prepare(Scene& scene, ArchiveSource& source, const StudyLevel& level,
                           MissingArchives missing) {
  PreparationOptions preparation = preparation_options(options_, listener_);
  preparation.note = [this](const std::string& text) {
    if (told_.insert(text).second) listener_.note(text);
  };
  preparation.warn = [&](const std::string& text) { tell_once(level, text); };
  return prepare_scene(scene, source, cache_, missing, preparation);
}

bool Study::is_prepared(const StudyLevel& level) {
  Scene scene = scene_at(scene_, level, nodes_);
  ArchiveSource source(listener_.progress);
  return prepare(scene, source, level, MissingArchives::count) == 0;
}

void Study::choose_levels(const Scene& scene, ArchiveSource& source) {
  std::size_t least = 0, total = 0;
  for (const BodySpec& body : scene.bodies) {
    const Archive& archive = source.open(body.archive);
    const bool rigid = archive.kind() == ModelKind::rigid;
    nodes_.push_back(rigid ? 0 : archive.geometry().nodes.vertices.size());
    if (rigid) continue;
    least = least == 0 ? nodes_.back() : std::min(least, nodes_.back());
    total += nodes_.back();
  }
  const long steps =
      options_.steps ? *options_.steps
                     : step_count(options_.duration.value_or(scene_.duration), scene_.time_step);
  if (steps == 0)
    throw Error(ErrorCode::usage, options_.scene +
                                      ": --convergence compares motions, and the scene "
                                      "is shorter than a time step");
  const LevelRange times = possible_times(options_.levels, steps);
  times_ = study_times(steps, every(), times);
  if (every() > steps)
    listener_.note("frames are farther apart than the run is long, " +
                   count_text(static_cast<std::size_t>(steps), "step") +
                   ": the motions are compared at " +
                   count_text(static_cast<std::size_t>(times_.count + 1), "time") +
                   " in their place (--every, --fps, \"every\")");
  levels_ = study_levels(
      total == 0 ? LevelRange{0, 0} : possible_meshes(options_.levels, least, total), times);
}

/// Where "place" has put the bodies of the scene they are put on all levels, whatever their meshes:
/// motions are compared, not places.
void Study::keep_places(const Scene& placed) {
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    scene_.bodies[b].position = placed.bodies[b].position;
    scene_.bodies[b].place.reset();
  }
}

void Study::announce() {
  const StudyCost& own = costs_[0];
  double expected = 0;
  std::size_t prepared = 0;
  for (std::size_t k = 1; k < levels_.size(); ++k) {
    const double matrices = cost_of_matrices(levels_[k]);
    expected += matrices * std::exp2(levels_[k].time) * own.simulation_seconds;
    if (is_prepared(levels_[k]))
      ++prepared;
    else
      expected += matrices * own.precompute_seconds.value_or(0);
  }
  listener_.note(
      "the scene took " + seconds_text(own.simulation_seconds) + " of processor time" +
      (own.precompute_seconds ? " and its matrices " + seconds_text(*own.precompute_seconds)
                              : std::string(" without its matrices")) +
      "; " + count_text(levels_.size() - 1, "more run") + ", up to " + label(levels_.back()) +
      ", take about " + seconds_text(expected) + " more (--coarser and --finer choose them" +
      (prepared > 0 ? "; the matrices of " + std::to_string(prepared) + " are in the cache)"
                    : std::string(")")));
}

void Study::run_level(const StudyLevel& level) {
  try {
    Scene scene = scene_at(scene_, level, nodes_);
    ArchiveSource source(listener_.progress);
    prepare(scene, source, level, MissingArchives::compute);
    simulate(std::move(scene), source, level);
  } catch (const Error& e) {
    throw Error(e.code(), "the run with " + label(level) + ": " + e.what());
  }
}

void Study::simulate(Scene scene, ArchiveSource& source, const StudyLevel& level) {
  Options options = options_;
  options.steps.reset();
  options.fps.reset();
  options.every = 1;
  options.duration = static_cast<double>(times_.steps()) * scene_.time_step;
  const std::unique_ptr<Plan> plan = make_plan(options, std::move(scene), source);
  if (runs_.empty()) keep_places(plan->scene);
  for (const std::string& warning : plan->warnings) tell_once(level, warning);
  check_memory(*plan);
  StudyCost cost = cost_of(*plan);
  PhaseTimer timer;
  timer.begin("simulation");
  runs_.push_back(simulate_level(plan->scene, source, level, times_, points_, [&](double part) {
    listener_.progress(
        "run " + std::to_string(runs_.size() + 1) + " of " + std::to_string(levels_.size()), part);
  }));
  timer.end();
  cost.simulation_seconds = timer.phases()[0].cpu_seconds;
  costs_.push_back(cost);
  const StudyRun& run = runs_.back();
  if (run.unmet_steps > 0)
    listener_.warn("the run with " + label(level) + ": the constraints were not met in " +
                   std::to_string(run.unmet_steps) + " of " +
                   count_text(static_cast<std::size_t>(run.steps), "step"));
}

StudyCost Study::cost_of(const Plan& plan) const {
  StudyCost cost;
  cost.precompute_seconds = 0;
  std::set<std::string> seen;
  for (const BodySpec& body : plan.scene.bodies) {
    const std::string& path = body.archive.resolved;
    if (!seen.insert(path).second) continue;
    const std::optional<double> seconds = cache_.seconds_to_make(path);
    if (seconds && cost.precompute_seconds)
      *cost.precompute_seconds += *seconds;
    else
      cost.precompute_seconds.reset();
    std::error_code unknown;
    const std::uintmax_t bytes = std::filesystem::file_size(path, unknown);
    if (!unknown) cost.archive_bytes += static_cast<double>(bytes);
  }
  return cost;
}

}  // namespace bem
