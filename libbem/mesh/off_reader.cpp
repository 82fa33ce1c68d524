#include "mesh/off_reader.hpp"

#include "mesh/describe.hpp"
#include "mesh/text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>

namespace bem {
namespace {

class OffParser {
 public:
  OffParser(std::string_view text, const std::string& source)
      : lines_(text, source, false), size_(text.size()) {}

  PolygonMesh parse() {
    parse_header();
    for (int v = 0; v < vertices_; ++v) parse_vertex();
    for (int f = 0; f < faces_; ++f) parse_face(f);
    if (lines_.next_filled())
      lines_.fail("more lines than the " + count_text(vertices_, "vertex") + " and " +
                  count_text(faces_, "face") + " that the file announces");
    return std::move(mesh_);
  }

 private:
  void parse_header() {
    take_line("the number of vertices");
    std::string_view word = lines_.word();
    if (const std::size_t at = word.rfind("OFF"); at != word.npos && at + 3 == word.size()) {
      parse_prefix(word.substr(0, at));
      word = lines_.word();
      if (word == "BINARY") lines_.fail("a binary OFF file is not supported: write it as text");
      if (word.empty()) {
        take_line("the number of vertices");
        word = lines_.word();
      }
    }
    vertices_ = parse_count(word, "the number of vertices");
    faces_ = parse_count(lines_.word(), "the number of faces");
  }

  /// Only those that say what stands behind the three coordinates.
  void parse_prefix(std::string_view prefix) {
    for (const std::string_view known : {"ST", "C", "N"})
      if (prefix.substr(0, known.size()) == known) {
        prefix.remove_prefix(known.size());
        has_extras_ = true;
      }
    if (!prefix.empty())
      lines_.fail("the kind " + quoted(prefix) + " of OFF file is not supported");
  }

  void take_line(const std::string& what) {
    if (!lines_.next_filled()) lines_.fail("the file ends where " + what + " should stand");
  }

  int parse_count(std::string_view word, const std::string& what) const {
    const int count = parse_integer(word, what);
    // every element takes two bytes or more
    if (count < 0 || static_cast<std::size_t>(count) > size_)
      lines_.fail(what + " cannot be " + quoted(word));
    return count;
  }

  int parse_integer(std::string_view word, const std::string& what) const {
    int value = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (code != std::errc() || end != word.data() + word.size())
      lines_.fail(quoted(word) + " is not " + what);
    return value;
  }

  void parse_vertex() {
    take_line("vertex " + std::to_string(mesh_.vertices.size()) + " of " +
              std::to_string(vertices_));
    Vec3 position;
    for (int k = 0; k < 3; ++k) {
      if (!lines_.has_word()) lines_.fail("a vertex needs three coordinates");
      position[k] = lines_.number();
    }
    if (!position.allFinite())
      lines_.fail("non-finite coordinate of vertex " + std::to_string(mesh_.vertices.size()) +
                  " (counting from 0)");
    check_rest_of_vertex();
    mesh_.vertices.push_back(position);
  }

  /// Colours may stand behind the coordinates although the header does not say so; other numbers
  /// mean that vertices do not have lines of their own.
  void check_rest_of_vertex() {
    std::size_t count = 0;
    while (!lines_.word().empty()) ++count;
    if (!has_extras_ && count != 0 && count != 3 && count != 4)
      lines_.fail(
          "a line of a vertex has three coordinates, and three or four numbers of a colour, "
          "but this one has " +
          std::to_string(3 + count) + " numbers");
  }

  void parse_face(int f) {
    take_line("face " + std::to_string(f) + " of " + std::to_string(faces_));
    const int corners = parse_integer(lines_.word(), "the number of corners of a face");
    if (corners < 1) lines_.fail("a face cannot have " + count_text(corners, "corner"));
    const std::size_t start = mesh_.corners.size();
    for (int k = 0; k < corners; ++k) {
      const std::string_view word = lines_.word();
      if (word.empty())
        lines_.fail("the face has " + count_text(k, "corner") + " instead of " +
                    std::to_string(corners));
      const int v = parse_integer(word, "the index of a vertex");
      if (v < 0 || v >= vertices_)
        lines_.fail("index out of range: face " + std::to_string(f) +
                    " (counting from 0) refers to vertex " + std::to_string(v) +
                    ", but the file has " + count_text(vertices_, "vertex"));
      mesh_.corners.push_back(v);
    }
    if (corners < 3) return mesh_.corners.resize(start);  // a point or a line
    mesh_.end_face();
    mesh_.lines.push_back(lines_.line());
  }

  TextLines lines_;
  std::size_t size_;
  PolygonMesh mesh_;
  bool has_extras_ = false;
  int vertices_ = 0;
  int faces_ = 0;
};

}  // namespace

PolygonMesh parse_off(std::string_view text, const std::string& source) {
  return OffParser(text, source).parse();
}

}  // namespace bem
