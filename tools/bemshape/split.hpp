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
/// triangles. A mesh that is no closed surface is parted, with a warning, into the sets of
/// triangles that share no vertex. Tells the files on `log`.
///
/// Throws ErrorCode::usage before anything is written if there are several parts and no %d, or if
/// the input would be overwritten; otherwise as read_mesh, check_elements and write_obj.
void split_mesh(const SplitOptions& options, Log& log);

}  // namespace bem
