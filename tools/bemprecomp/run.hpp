#pragma once

#include "common/cli.hpp"
#include "options.hpp"

namespace bem {

/// Computes an archive, or only says what that would take (--dry-run). Returns the exit code.
int run_precompute(const Options& options, Log& log);

}  // namespace bem
