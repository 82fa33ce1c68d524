#include "convergence.hpp"

#include "base/error.hpp"
#include "cache.hpp"
#include "files/pending_file.hpp"
#include "mesh/describe.hpp"
#include "output/output_directory.hpp"
#include "study.hpp"

#include <filesystem>
#include <ostream>

#include <nlohmann/json.hpp>

namespace bem {
namespace {

std::string json_file(const Options& options) {
  return options.output + "/convergence.json";
}

std::string svg_file(const Options& options) {
  return options.output + "/convergence.svg";
}

void check_no_study(const Options& options) {
  std::error_code unknown;
  for (const std::string& file : convergence_files(options))
    if (!options.force && std::filesystem::exists(file, unknown))
      throw Error(ErrorCode::usage,
                  file + ": there is a study of an earlier run; --force replaces it");
}

StudyReport run_study(Study& study) {
  try {
    return study.run();
  } catch (const Interrupted& e) {
    if (study.runs_done() == 0) throw;
    throw Interrupted(e.signal(), "; " + std::to_string(study.runs_done()) + " of " +
                                      count_text(study.run_count(), "run") +
                                      " are done; the matrices stay in the cache");
  }
}

}  // namespace

std::vector<std::string> convergence_files(const Options& options) {
  return {json_file(options), svg_file(options)};
}

int run_convergence(const Options& options, const Scene& scene, std::ostream& out, Log& log) {
  ProgressBar bar(log);
  Listener listener = listener_of(log, [&](const std::string& phase, double fraction) {
    check_interrupt();
    bar.update(phase, fraction);
  });
  Study study(options, scene, listener);
  const FolderLock lock = create_output_directory(options.output);
  check_no_study(options);
  const StudyReport report = run_study(study);
  bar.finish();
  PendingFile(json_file(options)).commit(report_json(report).dump(2) + "\n");
  PendingFile(svg_file(options)).commit(svg_of(report_plot(report)));
  out << report_text(report) << std::flush;
  return 0;
}

}  // namespace bem
