#pragma once

#include "output/output_directory.hpp"
#include "plan.hpp"
#include "preparation.hpp"
#include "recording/recorder.hpp"
#include "simulation/simulation.hpp"
#include "writers.hpp"

#include <memory>
#include <mutex>
#include <optional>

namespace bem::python {

/// A scene in motion, and the frames of it that are written: what `bemsim` does, step by step.
/// Python's threads may share it.
class Session {
 public:
  /// Prepares and loads what the scene needs, as bemsim does. Writes into `options.output`, if that
  /// is not empty, the start and then every frame that the options ask for. Throws as bemsim does.
  Session(const Options& options, Scene scene, const Listener& listener);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// One step, and its frame where one is due. A step that fails closes the output and is the last.
  void step();
  /// Completes the output; nothing is written from then on.
  void close();

  const Plan& plan() const { return *plan_; }
  /// What `use` makes of the simulation, while no other thread makes a step.
  template <class Use>
  auto with(const Use& use) {
    const std::lock_guard lock(mutex_);
    return use(*simulation_);
  }

 private:
  void open_output(const Options& options);
  void write_frame();
  void close_output();

  std::mutex mutex_;
  std::optional<FolderLock> lock_;
  std::unique_ptr<ArchiveSource> source_;
  std::unique_ptr<Plan> plan_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<Recorder> recorder_;
  std::unique_ptr<Writers> writers_;  ///< null: nothing is written
  std::size_t frames_ = 0;
  bool failed_ = false;
};

}  // namespace bem::python
