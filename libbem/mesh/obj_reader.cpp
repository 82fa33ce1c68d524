#include "mesh/obj_reader.hpp"

#include "mesh/describe.hpp"
#include "mesh/text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace bem {
namespace {

class ObjParser {
 public:
  ObjParser(std::string_view text, const std::string& source) : lines_(text, source, true) {}

  PolygonMesh parse() {
    while (lines_.next()) {
      const std::string_view keyword = lines_.word();
      if (keyword == "v") parse_vertex();
      if (keyword == "f") parse_face();
    }
    check_coordinates();
    check_indices();
    return std::move(mesh_);
  }

 private:
  void parse_vertex() {
    Vec3 position;
    for (int k = 0; k < 3; ++k) position[k] = parse_coordinate();
    if (!position.allFinite() && non_finite_++ == 0) {
      first_non_finite_ = static_cast<int>(mesh_.vertices.size());
      first_non_finite_line_ = lines_.line();
    }
    mesh_.vertices.push_back(position);
  }

  double parse_coordinate() {
    if (!lines_.has_word()) lines_.fail("a vertex needs three coordinates");
    return lines_.number();
  }

  void parse_face() {
    std::size_t count = 0;
    for (std::string_view word = lines_.word(); !word.empty(); word = lines_.word(), ++count)
      mesh_.corners.push_back(parse_corner(word));
    if (count < 3)
      lines_.fail("a face needs at least three vertices; delete this line, which has no area");
    mesh_.end_face();
    mesh_.lines.push_back(lines_.line());
  }

  /// Index from 0 of the vertex of "v", "v/vt", "v//vn" or "v/vt/vn"; -1 if the file's index is 0
  /// or reaches back before the first vertex.
  int parse_corner(std::string_view word) const {
    std::string_view rest = word;
    const int index = parse_index(rest, word);
    for (int part = 0; part < 2 && !rest.empty(); ++part) {
      if (rest.front() != '/') break;
      rest.remove_prefix(1);
      if (!rest.empty() && rest.front() != '/') parse_index(rest, word);
    }
    if (!rest.empty()) lines_.fail(quoted(word) + " is not a face corner");
    if (index > 0) return index - 1;
    if (index == 0) return -1;
    return std::max(-1, index + static_cast<int>(mesh_.vertices.size()));
  }

  int parse_index(std::string_view& rest, std::string_view word) const {
    int index = 0;
    const auto [end, code] = std::from_chars(rest.data(), rest.data() + rest.size(), index);
    if (code != std::errc()) lines_.fail(quoted(word) + " is not a face corner");
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    return index;
  }

  void check_coordinates() const {
    if (non_finite_ == 0) return;
    lines_.fail(first_non_finite_line_,
                "non-finite coordinate: " + vertex_text({mesh_.vertices, {}}, first_non_finite_) +
                    " (counting from 0); " + count_text(non_finite_, "such vertex") + " in all");
  }

  void check_indices() const {
    const int n = static_cast<int>(mesh_.vertices.size());
    std::size_t bad = 0;
    std::size_t first = 0;
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
      const int* const face = mesh_.face(f);
      const auto is_valid = [n](int v) { return v >= 0 && v < n; };
      if (std::all_of(face, face + mesh_.corner_count(f), is_valid)) continue;
      if (bad++ == 0) first = f;
    }
    if (bad == 0) return;
    lines_.fail(mesh_.lines[first],
                "index out of range: face " + std::to_string(first) +
                    " (counting from 0) refers to a vertex that the file does not have (it has " +
                    std::to_string(n) + "); " + count_text(bad, "such face") + " in all");
  }

  TextLines lines_;
  PolygonMesh mesh_;
  std::size_t non_finite_ = 0;
  int first_non_finite_ = 0;
  int first_non_finite_line_ = 0;
};

}  // namespace

PolygonMesh parse_obj(std::string_view text, const std::string& source) {
  return ObjParser(text, source).parse();
}

}  // namespace bem
