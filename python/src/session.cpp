#include "session.hpp"

#include "base/error.hpp"
#include "recorded_bodies.hpp"

namespace bem::python {
namespace {

ExistingOutput existing(const Options& options) {
  return options.force ? ExistingOutput::replace : ExistingOutput::refuse;
}

}  // namespace

Session::Session(const Options& options, Scene scene, const Listener& listener) {
  if (!options.output.empty()) {
    lock_.emplace(create_output_directory(options.output));
    prepare_output_directory(options.output,
                             options.force ? ExistingOutput::keep : ExistingOutput::refuse);
  }
  source_ = std::make_unique<ArchiveSource>(listener.progress);
  if (needs_cache(scene))
    prepare_scene(scene, *source_, cache_of(options), MissingArchives::compute,
                  preparation_options(options, listener));
  plan_ = make_plan(options, std::move(scene), *source_);
  for (const std::string& note : plan_->notes) listener.note(note);
  for (const std::string& warning : plan_->warnings) listener.warn(warning);
  check_memory(*plan_);
  simulation_ = std::make_unique<Simulation>(plan_->scene, *source_);
  for (const std::string& warning : warnings_of_start(*simulation_)) listener.warn(warning);
  recorder_ = make_recorder(*plan_);
  if (!options.output.empty()) open_output(options);
}

Session::~Session() {
  try {
    close();
  } catch (const Error&) {  // who wants to know calls close()
  }
}

void Session::open_output(const Options& options) {
  prepare_output_directory(options.output, existing(options));
  writers_ = std::make_unique<Writers>(plan_->scene.output.formats, recorder_->contents(),
                                       options.output, 0, OutputRecords());
  write_frame();
}

void Session::write_frame() {
  writers_->write(recorder_->frame(*simulation_, frames_));
  ++frames_;
}

void Session::step() {
  const std::lock_guard lock(mutex_);
  if (failed_) throw Error(ErrorCode::usage, "the simulation has failed in an earlier step");
  try {
    simulation_->step();
    if (writers_ && plan_->schedule.contains(simulation_->steps())) write_frame();
  } catch (...) {
    failed_ = true;
    close_output();
    throw;
  }
}

void Session::close_output() {
  if (writers_) writers_->close();
  writers_.reset();
  lock_.reset();
}

void Session::close() {
  const std::lock_guard lock(mutex_);
  close_output();
}

}  // namespace bem::python
