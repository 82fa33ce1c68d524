#pragma once

#include "base/state_archive.hpp"

#include <string>

namespace bem {

/// What a checkpoint begins with: what a run that goes on must have in common with the one that it
/// goes on from. The number of steps (long) and the state of the simulation follow it.
struct RunIdentity {
  std::string program;   ///< name and version
  std::string scene;     ///< but for its duration, with the output that is asked for
  std::string archives;  ///< digests of archives, obstacles, render meshes and the initial state

  void visit_state(StateArchive& state) { state(program, scene, archives); }
};

}  // namespace bem
