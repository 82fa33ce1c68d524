#pragma once

#include "common/cli.hpp"
#include "options.hpp"
#include "plan.hpp"
#include "simulation/archive_source.hpp"

namespace bem {

/// Simulates a plan and writes its frames. Whatever ends the run early leaves all frames so far
/// readable, and statistics and a checkpoint where they are asked for. Returns 0; throws
/// ErrorCode::numerical, ErrorCode::resources, Interrupted.
int run_simulation(const Plan& plan, ArchiveSource& source, const Options& options, Log& log);

}  // namespace bem
