#pragma once

#include "common/log.hpp"

#include <string>

namespace bem {

/// `bemshape split IN -o 'part-%d.obj'`.
struct SplitOptions {
  std::string input;
  std::string pattern;  ///< of the files to write, with %d for their numbers from 0
};

/// Writes each separate solid of a mesh, with its cavities, as an OBJ file: outward triangles and
/// the vertices that they use, both in the order of the input; solids in the order of their first
/// triangles. Tells the files on `log`.
///
/// Throws ErrorCode::usage before anything is written if there are several solids and no %d, or if
/// the input would be overwritten; otherwise as read_mesh, make_surface and write_obj.
void split_mesh(const SplitOptions& options, Log& log);

}  // namespace bem
