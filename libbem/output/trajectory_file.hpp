#pragma once

#include "base/types.hpp"
#include "files/hdf5.hpp"

#include <array>
#include <string>
#include <vector>

namespace bem {

/// A trajectory.h5 (docs/trajectory-format.md, version 1 or 2) that is read back. Structure, types
/// and extents are checked before anything is read, and that numbers are finite when they are.
/// Everything throws Error with the code that it was opened with and a message that names file and
/// place.
class TrajectoryFile {
 public:
  /// Opens a complete trajectory, or one whose writer was stopped. Reads it once (file_check.hpp).
  TrajectoryFile(const std::string& path, ErrorCode error);

  const std::string& path() const { return file_.path(); }
  const std::vector<double>& times() const { return times_; }  ///< of the frames, ascending [s]
  std::size_t body_count() const { return file_.children("/bodies").size(); }
  bool has_body(const std::string& body) const;
  /// Is it a render mesh, not the simulated surface?
  bool is_render_mesh(const std::string& body) const;
  std::size_t vertices(const std::string& body) const;
  /// Has the body a field or series of this name ("/tractions", "/series/momentum")?
  bool has(const std::string& body, const std::string& name) const;
  /// Vertex indices.
  std::vector<std::array<int, 3>> faces(const std::string& body) const;

  /// A frame of what the body has under `name` ("/positions"), with extents [frames, ...extents].
  void read(const std::string& body, const std::string& name, const Hdf5Dims& extents,
            std::size_t frame, double* out) const;

 private:
  std::string series(const std::string& body, const std::string& name) const;
  void check_finite(const std::string& path, const double* numbers, std::size_t count) const;

  Hdf5File file_;
  std::vector<double> times_;
};

}  // namespace bem
