#pragma once

#include "repair/acceptance.hpp"
#include "repair/repair_options.hpp"

#include <string>
#include <vector>

namespace bem {

/// What mend() made of a mesh.
struct Mended {
  TriangleMesh mesh;
  Acceptance acceptance;           ///< of the mesh
  std::vector<std::string> steps;  ///< what changed it
  bool sheet = false;              ///< every part is open, with holes too large to be filled
  std::vector<std::size_t> holes;  ///< numbers of edges of holes that were left
};

/// The steps of a repair that keep the surface where it is (repair/repair.hpp), on a mesh in unit
/// coordinates (repair/unit_frame.hpp). `size` is what lengths in the steps' sentences are
/// multiplied by.
Mended mend(const TriangleMesh& mesh, const RepairOptions& options, double size);

}  // namespace bem
