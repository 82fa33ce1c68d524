#pragma once

#include "files/state_file.hpp"
#include "options.hpp"
#include "plan.hpp"
#include "simulation/run_identity.hpp"

#include <memory>
#include <string>

namespace bem {

/// Reads the scene's file again. Throws ErrorCode::invalid_input, ErrorCode::resources.
RunIdentity identity_of(const Plan& plan, const Options& options);

/// The file in the output directory.
std::string checkpoint_path(const std::string& directory);

/// Opens the checkpoint of an earlier run, and leaves it to the caller to restore the rest. Throws
/// ErrorCode::usage if there is none or it is beyond the end of this run, ErrorCode::invalid_input
/// if it is damaged or of another scene or version of the program, ErrorCode::archive if archives
/// or obstacles have changed. `steps`: of the state.
std::unique_ptr<StateReader> open_checkpoint(const std::string& directory,
                                             const RunIdentity& identity, long planned_steps,
                                             long& steps);

/// Saves a state under the name of the checkpoint; what has that name stays until this one is
/// complete. Throws ErrorCode::resources.
template <class... Parts>
void save_checkpoint(const std::string& directory, RunIdentity identity, long steps,
                     Parts&... parts) {
  StateWriter writer(checkpoint_path(directory));
  writer(identity, steps, parts...);
  writer.commit();
}

}  // namespace bem
