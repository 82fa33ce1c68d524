#pragma once

#include <string>

namespace bem {

/// Where an archive comes from, for its reader's information only. Nothing in it may differ between
/// two runs with the same inputs: no times, host names, thread counts or folders.
struct Provenance {
  std::string program;    ///< "bem 0.1.0"
  std::string mesh_file;  ///< names without folders
  std::string material_file;
  double mesh_scale = 1;  ///< factor on the coordinates of the mesh file
  std::string options;    ///< options that determine the matrices, in a fixed order
};

}  // namespace bem
