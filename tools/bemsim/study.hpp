#pragma once

#include "convergence_report.hpp"
#include "preparation.hpp"

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace bem {

/// Runs of a scene on other meshes and with other time steps. The options outlive it.
class Study {
 public:
  /// Throws ErrorCode::invalid_input, naming the place in the scene, for a body that has no other
  /// meshes.
  Study(const Options& options, const Scene& scene, Listener listener);

  /// Throws, naming the run, what preparation, simulation and the listener throw.
  StudyReport run();
  /// That are done, and that there are in all; none before the scene's own.
  std::size_t runs_done() const { return runs_.size(); }
  std::size_t run_count() const { return levels_.size(); }

 private:
  void run_scene();
  void tell_once(const StudyLevel& level, const std::string& warning);
  std::size_t prepare(Scene& scene, ArchiveSource& source, const StudyLevel& level,
                      MissingArchives missing);
  bool is_prepared(const StudyLevel& level);
  void choose_levels(const Scene& scene, ArchiveSource& source);
  long every() const;
  void keep_places(const Scene& placed);
  void announce();
  void run_level(const StudyLevel& level);
  void simulate(Scene scene, ArchiveSource& source, const StudyLevel& level);
  StudyCost cost_of(const Plan& plan) const;
  std::string label(const StudyLevel& level) const;

  const Options& options_;
  Scene scene_;
  ArchiveCache cache_;
  Listener listener_;
  std::vector<std::shared_ptr<const FollowedPoints>> points_;
  std::vector<std::size_t> nodes_;  ///< by body in the scene's own run; 0 of rigid ones
  std::vector<StudyLevel> levels_;
  StudyTimes times_;
  std::vector<StudyRun> runs_;
  std::vector<StudyCost> costs_;
  std::set<std::string> told_;  ///< what was said, which runs may have in common
};

}  // namespace bem
