#pragma once

#include "render/point_normal.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace bem {

/// The text of an OBJ file without what changes when its vertices move. All that it says of faces,
/// texture coordinates, groups, materials, lines and free-form surfaces stays word by word, and so
/// do comments. Three things are filled in: coordinates of vertices, normals, and paths of material
/// libraries.
///
/// Normals become those of pairs: where a file gives one normal to corners at several vertices, the
/// vertices turn it in different ways. The first of them keeps its number, those of the others
/// follow after the file's, and all are listed where the file has its first one. Corners with a
/// normal that the file does not have lose it.
class ObjTemplate {
 public:
  ObjTemplate() = default;
  /// Takes a text that parse_obj() (mesh/obj_reader.hpp) accepts. O(n log n).
  explicit ObjTemplate(std::string_view text);

  /// Each normal of the file at each of the vertices that have it; `point` is -1 if none has.
  const std::vector<PointNormal>& normals() const { return normals_; }
  const std::vector<std::array<double, 2>>& uvs() const { return uvs_; }
  /// For the corners of all faces in their order the index in uvs(), -1 for a corner without.
  const std::vector<int>& corner_uvs() const { return corner_uvs_; }
  /// What follows the word mtllib in every statement of that kind.
  const std::vector<std::string>& libraries() const { return libraries_; }

  /// The text with vertices and normals, and with what shall follow the words mtllib. Coordinates
  /// are shortest decimals that read back to the same double, those of normals to the same float.
  std::string text(const std::vector<Vec3>& vertices, const std::vector<Vec3>& normals,
                   const std::vector<std::string>& libraries) const;

 private:
  friend class ObjTemplateParser;

  /// Where the fixed text has room for the next vertex, for all normals, or the next libraries.
  struct Gap {
    enum class Kind { vertex, normals, libraries };
    std::size_t at;
    Kind kind;
  };

  std::string fixed_;
  std::string line_end_ = "\n";
  std::vector<Gap> gaps_;
  std::vector<PointNormal> normals_;
  std::vector<std::array<double, 2>> uvs_;
  std::vector<int> corner_uvs_;
  std::vector<std::string> libraries_;
};

}  // namespace bem
