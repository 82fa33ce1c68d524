#pragma once

#include "convergence/convergence_study.hpp"
#include "convergence/log_plot.hpp"

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace bem {

/// What a run has taken.
struct StudyCost {
  std::optional<double> precompute_seconds;  ///< processor time of the archives, where it is known
  double simulation_seconds = 0;             ///< processor time
  double archive_bytes = 0;
};

/// A study that is complete.
struct StudyReport {
  std::string program;
  Scene scene;  ///< with its time step
  StudyTimes times;
  std::vector<StudyRun> runs;    ///< in the order of study_levels()
  std::vector<StudyCost> costs;  ///< by run
  StudyResult result;
};

/// The table and what it says, for people.
std::string report_text(const StudyReport& report);
nlohmann::ordered_json report_json(const StudyReport& report);
/// Errors of positions against processor time.
LogPlot report_plot(const StudyReport& report);

}  // namespace bem
