#include "run.hpp"

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "checkpoint.hpp"
#include "files/pending_file.hpp"
#include "mesh/describe.hpp"
#include "output/output_directory.hpp"
#include "recorded_bodies.hpp"
#include "stats.hpp"
#include "writers.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace bem {
namespace {

/// One run: the simulation, its output and what is measured.
class Run {
 public:
  Run(const Plan& plan, ArchiveSource& source, const Options& options, Log& log)
      : plan_(plan), options_(options), log_(log), statistics_(plan), bar_(log) {
    if (!options.stats.empty()) stats_file_ = std::make_unique<PendingFile>(options.stats);
    timer_.begin(kLoadingPhase);
    if (options.resume || options.checkpoint_every > 0) identity_ = identity_of(plan, options);
    std::unique_ptr<StateReader> earlier;
    if (options.resume) earlier = open_checkpoint(options.output, identity_, plan.steps, saved_);
    simulation_ = std::make_unique<Simulation>(plan.scene, source);
    statistics_.prepare(*simulation_);
    recorder_ = make_recorder(plan);
    check_interrupt();
    bar_.finish();
    log_.detail(bytes_text(static_cast<double>(simulation_->matrix_bytes())) +
                " of matrices from " + count_text(simulation_->archives(), "archive"));
    for (const std::string& warning : warnings_of_start(*simulation_)) log_.warning(warning);
    if (earlier) restore(*earlier);
    prepare_output_directory(options.output, options.resume  ? ExistingOutput::keep
                                             : options.force ? ExistingOutput::replace
                                                             : ExistingOutput::refuse);
    writers_ = std::make_unique<Writers>(plan.scene.output.formats, recorder_->contents(),
                                         options.output, frames(), kept_);
  }

  /// Steps to the end, a failure or an interruption, and completes the files in each case.
  void go() {
    try {
      advance();
    } catch (const Interrupted& e) {
      save_early();
      finish_early("interrupted");
      throw Interrupted(e.signal(), (abandoned_ ? " within a step; " : "; ") + progress());
    } catch (const Error& e) {
      finish_early("failed");
      throw Error(e.code(), std::string(e.what()) + "; " + progress());
    }
    finish("complete");
    log_.info("complete: " + progress() + " in " + seconds_text(timer_.total_wall_seconds()));
  }

 private:
  void advance() {
    set_interruption_check(check_overdue_interrupt);  // a step that has begun may end
    if (statistics_.frames() == 0) write_frame();
    while (simulation_->steps() < plan_.steps) {
      check_interrupt();
      timer_.begin(kSteppingPhase);
      step();
      if (const auto unmet = statistics_.record_step(*simulation_)) log_.detail(*unmet);
      if (plan_.schedule.contains(simulation_->steps())) write_frame();
      if (options_.checkpoint_every > 0 && simulation_->steps() % options_.checkpoint_every == 0)
        save();
      bar_.update(kSteppingPhase,
                  static_cast<double>(simulation_->steps()) / static_cast<double>(plan_.steps));
    }
    if (options_.checkpoint_every > 0) save();
  }

  /// One that fails while constraints are not met says what helps.
  void step() {
    try {
      simulation_->step();
    } catch (const Interrupted&) {
      abandoned_ = true;
      throw;
    } catch (const Error& e) {
      if (e.code() != ErrorCode::numerical || simulation_->statistics().converged()) throw;
      const std::string impossible = plan_.impossible(simulation_->time());
      throw Error(e.code(),
                  std::string(e.what()) + ": the constraints of the step were not met, " +
                      (impossible.empty() ? "use a shorter time step" : "because " + impossible));
    }
  }

  void restore(StateReader& earlier) {
    earlier(*simulation_);
    earlier.resizable(kept_);
    earlier(statistics_, timer_);
    earlier.finish();
    earlier.check(simulation_->steps() == saved_ && saved_ >= 0 &&
                  statistics_.frames() == plan_.schedule.count(saved_));
    check_output_records(plan_.scene.output.formats, recorder_->contents(), options_.output,
                         frames(), kept_);
    log_.info("going on from t = " + to_text(simulation_->time()) + " s: " + progress());
    timer_.begin(kLoadingPhase);
  }

  std::size_t frames() const { return static_cast<std::size_t>(statistics_.frames()); }

  /// After the frames of the state, which are on the disk when it is.
  void save() {
    const long steps = simulation_->steps();
    if (steps == saved_) return;
    timer_.begin(kCheckpointPhase);
    OutputRecords records = writers_->sync();
    save_checkpoint(options_.output, identity_, steps, *simulation_, records, statistics_, timer_);
    saved_ = steps;
  }

  /// Without a checkpoint the last one is still there. A step that was abandoned leaves no state to
  /// save.
  void save_early() {
    try {
      if (options_.checkpoint_every > 0 && !abandoned_) save();
    } catch (const Error& e) {
      log_.warning(e.what());
    }
  }

  void write_frame() {
    timer_.begin(kOutputPhase);
    writers_->write(recorder_->frame(*simulation_, frames()));
    statistics_.record_frame();
  }

  void finish(const std::string& outcome) {
    bar_.finish();
    timer_.begin(kOutputPhase);
    writers_->close();
    timer_.end();
    for (const std::string& text : statistics_.warnings(plan_, *simulation_)) log_.warning(text);
    if (stats_file_)
      stats_file_->commit(statistics_.json(plan_, *simulation_, timer_, outcome).dump(2) + "\n");
  }

  /// What came first is the answer: if the files cannot be completed either, that is a warning.
  void finish_early(const std::string& outcome) {
    set_interruption_check({});  // the signal has been heard; a second one ends the process
    try {
      finish(outcome);
    } catch (const Error& e) {
      log_.warning(e.what());
    }
  }

  /// "20 of 50 steps, 21 frames".
  std::string progress() const {
    const long steps = simulation_->steps();
    return (steps == plan_.steps ? "" : std::to_string(steps) + " of ") +
           count_text(static_cast<std::size_t>(plan_.steps), "step") + ", " +
           count_text(static_cast<std::size_t>(statistics_.frames()), "frame");
  }

  const Plan& plan_;
  const Options& options_;
  Log& log_;
  RunIdentity identity_;    ///< where there are checkpoints
  long saved_ = -1;         ///< step of the last checkpoint
  bool abandoned_ = false;  ///< the last step has not come to its end
  RunStatistics statistics_;
  PhaseTimer timer_;
  ProgressBar bar_;
  std::unique_ptr<PendingFile> stats_file_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<Recorder> recorder_;
  OutputRecords kept_;  ///< of the frames of an earlier run
  std::unique_ptr<Writers> writers_;
};

/// Notices early what prepare_output_directory would refuse, but removes nothing yet.
void check_output(const Options& options) {
  prepare_output_directory(options.output, options.force || options.resume
                                               ? ExistingOutput::keep
                                               : ExistingOutput::refuse);
}

}  // namespace

int run_simulation(const Plan& plan, ArchiveSource& source, const Options& options, Log& log) {
  const FolderLock lock = create_output_directory(options.output);
  check_output(options);
  Run run(plan, source, options, log);
  run.go();
  return 0;
}

}  // namespace bem
