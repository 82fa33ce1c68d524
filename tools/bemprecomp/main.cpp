/// bemprecomp: turns a mesh and a material into a matrix archive.

#include "archive/archive_reader.hpp"
#include "base/interruption.hpp"
#include "base/parallel.hpp"
#include "common/cli.hpp"
#include "diff.hpp"
#include "options.hpp"
#include "report.hpp"
#include "run.hpp"

#include <iostream>

namespace {

using bem::Options;

int verify(const std::string& path, bem::Log& log) {
  const bem::Archive archive(path);
  bem::ProgressBar bar(log);
  archive.check_matrices([&](const std::string& phase, double fraction) {
    bem::check_interrupt();
    bar.update(phase, fraction);
  });
  bar.finish();
  std::cout << path << ": intact\n";
  return 0;
}

int info(const std::string& path, bool json) {
  const bem::Archive archive(path);
  if (json)
    std::cout << bem::info_json(archive).dump(2) << "\n";
  else
    bem::print_info(std::cout, archive);
  return 0;
}

int diff(const std::vector<std::string>& paths, bem::Log& log) {
  const bem::Archive a(paths[0]), b(paths[1]);
  bem::ProgressBar bar(log);
  const bool equal =
      bem::print_differences(std::cout, a, b, [&](const std::string& phase, double fraction) {
        bem::check_interrupt();
        bar.update(phase, fraction);
      });
  return equal ? 0 : 1;
}

int run(int argc, char** argv, bem::Log& log) {
  const auto options = bem::parse_options(argc, argv);
  if (!options) return 0;
  if (options->quiet) log.set_verbosity(bem::Verbosity::quiet);
  if (options->verbose) log.set_verbosity(bem::Verbosity::verbose);
  if (!options->log_file.empty()) log.open_file(options->log_file);
  if (options->threads) bem::set_thread_count(*options->threads);
  bem::catch_interrupts();
  bem::set_interruption_check(bem::check_interrupt);
  switch (options->action) {
    case Options::Action::info:
      return info(options->archives[0], options->json);
    case Options::Action::verify:
      return verify(options->archives[0], log);
    case Options::Action::diff:
      return diff(options->archives, log);
    case Options::Action::precompute:
      break;
  }
  return bem::run_precompute(*options, log);
}

}  // namespace

int main(int argc, char** argv) {
  bem::Log log;
  return bem::run_tool(log, [&] { return run(argc, argv, log); });
}
