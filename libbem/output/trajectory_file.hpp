#pragma once

#include "base/types.hpp"
#include "files/hdf5.hpp"

#include <cstdint>
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
  ErrorCode error() const { return file_.error(); }
  const std::vector<double>& times() const { return times_; }  ///< of the frames, ascending [s]
  std::size_t body_count() const { return file_.children("/bodies").size(); }
  /// Names of the groups below "/bodies" or "/obstacles", none if there is no such group: by their
  /// attribute "index", or in byte order where they have none.
  std::vector<std::string> names(const std::string& group) const;
  bool has_body(const std::string& body) const;
  /// Is it a render mesh, not the simulated surface?
  bool is_render_mesh(const std::string& body) const;
  std::size_t vertices(const std::string& body) const;
  /// Has the body a field or series of this name ("/tractions", "/series/momentum")?
  bool has(const std::string& body, const std::string& name) const;
  /// Vertex indices.
  std::vector<Triangle> faces(const std::string& body) const;

  /// A frame of what the body has under `name` ("/positions"), with extents [frames, ...extents].
  void read(const std::string& body, const std::string& name, const Hdf5Dims& extents,
            std::size_t frame, double* out) const;

  // What else is in the file, by its path in it ("/bodies/NAME/series/momentum").

  bool has(const std::string& path) const { return file_.exists(path); }
  /// Names of what is in a group; none if there is none.
  std::vector<std::string> children(const std::string& group) const;
  std::size_t row_count(const std::string& path) const;
  Hdf5Dims row_extents(const std::string& path) const;
  /// Text of an attribute; empty if there is none.
  std::string text(const std::string& object, const std::string& attribute) const;
  /// Number of an attribute, which must be there and finite.
  double number(const std::string& object, const std::string& attribute) const;
  /// Integer of an attribute, or `otherwise` if there is none.
  std::int64_t integer(const std::string& object, const std::string& attribute,
                       std::int64_t otherwise) const;
  /// The rows of a dataset of `type` with extents [rows, ...extents], from `first` to before `end`,
  /// which must be there.
  std::vector<double> rows(const std::string& path, const Hdf5Dims& extents, std::size_t first,
                           std::size_t end, Hdf5Type type = Hdf5Type::float64) const;
  /// All frames of one.
  std::vector<double> all_frames(const std::string& path, const Hdf5Dims& extents) const {
    return rows(path, extents, 0, times_.size());
  }
  /// Triangles of a dataset, whose vertex indices are less than `vertices`.
  std::vector<Triangle> triangles(const std::string& path, std::size_t vertices) const;

 private:
  std::string series(const std::string& body, const std::string& name) const;
  void check_rows(const std::string& path, const Hdf5Dims& extents, std::size_t rows,
                  Hdf5Type type) const;
  void check_finite(const std::string& path, const double* numbers, std::size_t count) const;

  Hdf5File file_;
  std::vector<double> times_;
};

}  // namespace bem
