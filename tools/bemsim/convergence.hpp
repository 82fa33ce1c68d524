#pragma once

#include "common/cli.hpp"
#include "options.hpp"

#include <iosfwd>

namespace bem {

/// What a study writes into the output folder.
std::vector<std::string> convergence_files(const Options& options);

/// Runs a scene on other meshes and with other time steps, prints what they cost and how much their
/// motions differ, and writes that as JSON and as a picture. Returns 0. Throws, naming the run,
/// what preparation and simulation throw, and ErrorCode::usage if the files are there and are not
/// to be replaced.
int run_convergence(const Options& options, const Scene& scene, std::ostream& out, Log& log);

}  // namespace bem
