#include "run.hpp"

#include "archive/archive_writer.hpp"
#include "base/error.hpp"
#include "files/pending_file.hpp"
#include "mesh/describe.hpp"
#include "model/growth.hpp"
#include "model/memory_estimate.hpp"
#include "preparation/archive_match.hpp"
#include "report.hpp"

#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>

namespace bem {
namespace {

constexpr double kNoticeableGrowth = 1.0005;

/// The material damping that holds the motion that grows, and a tenth more, besides the damping
/// there is; as an option of bemprecomp. Empty if it would be strong, or would not help.
std::string damping_text(const BodyModel& model) {
  constexpr double kStrong = 0.2;  // time steps
  const double dt = model.discretisation.dt, hertz = model.report.growth_frequency;
  if (hertz == 0) return "";
  const double time = model.discretisation.damping.time +
                      1.1 * dt * holding_damping(model.report.growth, hertz * dt);
  if (time > kStrong * dt) return "";
  return ", or --damping kelvin_voigt:" + rounded_text(time, 2) +
         ", which takes less of what is slower than " + rounded_text(hertz, 3) + " Hz";
}

/// Empty if motions do not grow noticeably.
std::string growth_warning(const BodyModel& model) {
  const double growth = model.report.growth, left = growth * model.window;
  const bool galerkin = model.discretisation.is_galerkin();
  const std::string cure = std::string(galerkin ? "" : "--discretisation galerkin, ") +
                           "a larger --dt, a smaller theta, or a finer mesh" + damping_text(model);
  if (left > kNoticeableGrowth)
    return "motions grow by a factor of " + rounded_text(left, 6) +
           " per step; --window auto removes that, better are " + cure;
  if (growth > kNoticeableGrowth)
    return "motions would grow by a factor of " + rounded_text(growth, 6) +
           " per step; the window " + rounded_text(model.window, 6) + " removes that, but takes " +
           rounded_text(std::round(100 * (1 - std::pow(model.window, model.report.lam))), 6) +
           " % of every vibration while a shear wave crosses the body: better are " + cure;
  return "";
}

std::string history_text(int steps) {
  return steps == 0 ? "no history" : "history of " + std::to_string(steps) + " steps";
}

/// Follows the phases of the work: timer, progress bar, and the check for Ctrl-C.
class Phases {
 public:
  explicit Phases(Log& log) : bar_(log), log_(log) {}

  void begin(const std::string& phase) { update(phase, 0); }

  void update(const std::string& phase, double fraction) {
    check_interrupt();
    {
      const std::lock_guard lock(mutex_);
      if (phase != current_) log_.detail(phase);
      current_ = phase;
      timer_.begin(phase);
    }
    bar_.update(phase, fraction);
  }

  void finish() {
    timer_.end();
    bar_.finish();
  }

  Progress callback() {
    return [this](const std::string& phase, double fraction) { update(phase, fraction); };
  }
  const PhaseTimer& timer() const { return timer_; }

 private:
  ProgressBar bar_;
  Log& log_;
  std::mutex mutex_;
  PhaseTimer timer_;
  std::string current_;
};

int run_dry(const Plan& plan, Log& log) {
  if (plan.peak > static_cast<double>(physical_memory()))
    log.warning("the machine has not enough memory for this");
  print_plan(std::cout, plan,
             estimate_time(plan.body.geometry, plan.body.options, plan.body.quadrature));
  return 0;
}

}  // namespace

int run_precompute(const Options& o, Log& log) {
  if (!o.dry_run) check_archive_target(o.output, true);
  Phases phases(log);
  phases.begin("mesh");
  Plan plan = make_plan(o);
  std::vector<std::string> warnings = plan.body.warnings;
  for (const std::string& w : warnings) log.warning(w);
  for (const std::string& note : plan.body.notes) log.info(note);
  if (o.dry_run) return run_dry(plan, log);
  if (!o.force &&
      is_up_to_date(o.output, plan.body, version_text(), SettingStyle::option, o.if_changed)) {
    log.info(o.output + ": up to date");
    return 0;
  }
  check_memory(plan.body, static_cast<double>(physical_memory()), SettingStyle::option);
  const BodyGeometry& geometry = plan.body.geometry;
  const PrecomputeOptions& options = plan.body.options;
  check_archive_target(o.output, true,
                       archive_bytes(geometry, options, certain_bytes(geometry, options)));
  std::optional<PendingFile> stats;  // a bad path is noticed before the work
  if (!o.stats.empty()) stats.emplace(o.stats);
  if (o.settings.model != ModelKind::rigid)
    log.info(std::to_string(plan.body.geometry.nodes.vertices.size()) + " nodes, " +
             history_text(plan.body.options.discretisation.history_length) + ", " + "about " +
             bytes_text(plan.peak) + " of memory");

  phases.begin("tables");
  const BodyModel model =
      precompute(std::move(plan.body.geometry), plan.body.options, phases.callback());
  const std::string growth = growth_warning(model);
  if (!growth.empty()) {
    warnings.push_back(growth);
    log.warning(growth);
  }
  write_archive(o.output, model, provenance_of(plan.inputs, plan.body, version_text()),
                o.force || o.if_changed, phases.callback());
  phases.finish();
  if (stats) stats->commit(stats_json(model, o.output, phases.timer(), warnings).dump(2) + "\n");
  log.info(o.output + ": " + bytes_text(static_cast<double>(std::filesystem::file_size(o.output))) +
           " in " + seconds_text(phases.timer().total_wall_seconds()));
  return 0;
}

}  // namespace bem
