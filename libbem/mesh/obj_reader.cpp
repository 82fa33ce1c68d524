#include "mesh/obj_reader.hpp"

#include "base/error.hpp"
#include "mesh/describe.hpp"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <system_error>

namespace bem {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

class ObjParser {
 public:
  ObjParser(std::string_view text, const std::string& source) : rest_(text), source_(source) {
    if (rest_.substr(0, 3) == "\xEF\xBB\xBF") rest_.remove_prefix(3);
  }

  TriangleMesh parse() {
    std::string line;
    while (next_line(line)) parse_line(line);
    check_coordinates();
    check_indices();
    return std::move(mesh_);
  }

 private:
  /// One line without its comment; a backslash at the end continues it on the next one.
  bool next_line(std::string& line) {
    if (rest_.empty()) return false;
    line.clear();
    line_ = next_line_;
    for (bool more = true; more && !rest_.empty();) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      std::string_view piece = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++next_line_;
      while (!piece.empty() && piece.back() == '\r') piece.remove_suffix(1);
      more = !piece.empty() && piece.back() == '\\';
      if (more) piece.remove_suffix(1);
      line.append(piece);
      if (more) line.push_back(' ');
    }
    line.resize(std::min(line.find('#'), line.size()));
    return true;
  }

  static std::string_view next_token(std::string_view& line) {
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    std::size_t n = 0;
    while (n < line.size() && !is_blank(line[n])) ++n;
    const std::string_view token = line.substr(0, n);
    line.remove_prefix(n);
    return token;
  }

  void parse_line(std::string_view line) {
    const std::string_view keyword = next_token(line);
    if (keyword == "v") parse_vertex(line);
    if (keyword == "f") parse_face(line);
  }

  void parse_vertex(std::string_view line) {
    Vec3 position;
    for (int k = 0; k < 3; ++k) {
      const std::string_view token = next_token(line);
      if (token.empty()) fail(line_, "a vertex needs three coordinates");
      position[k] = parse_coordinate(token);
    }
    if (!position.allFinite() && non_finite_++ == 0) {
      first_non_finite_ = static_cast<int>(mesh_.vertices.size());
      first_non_finite_line_ = line_;
    }
    mesh_.vertices.push_back(position);
  }

  double parse_coordinate(std::string_view token) const {
    std::string_view number = token;
    if (number.size() > 1 && number[0] == '+' && number[1] != '-') number.remove_prefix(1);
    double value = 0;
    const auto [end, code] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (code == std::errc::result_out_of_range)
      fail(line_, quoted(token) + " is outside the range of double precision");
    if (code != std::errc() || end != number.data() + number.size())
      fail(line_, quoted(token) + " is not a number");
    return value;
  }

  void parse_face(std::string_view line) {
    std::vector<int> polygon;
    for (std::string_view token = next_token(line); !token.empty(); token = next_token(line))
      polygon.push_back(parse_corner(token));
    if (polygon.size() < 3) fail(line_, "a face needs at least three vertices");
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      mesh_.triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
      triangle_lines_.push_back(line_);
    }
  }

  /// Index from 0 of the vertex of "v", "v/vt", "v//vn" or "v/vt/vn"; -1 if the file's index is 0
  /// or reaches back before the first vertex.
  int parse_corner(std::string_view token) const {
    std::string_view rest = token;
    const int index = parse_index(rest, token);
    for (int part = 0; part < 2 && !rest.empty(); ++part) {
      if (rest.front() != '/') break;
      rest.remove_prefix(1);
      if (!rest.empty() && rest.front() != '/') parse_index(rest, token);
    }
    if (!rest.empty()) fail(line_, quoted(token) + " is not a face corner");
    if (index > 0) return index - 1;
    if (index == 0) return -1;
    return std::max(-1, index + static_cast<int>(mesh_.vertices.size()));
  }

  int parse_index(std::string_view& rest, std::string_view token) const {
    int index = 0;
    const auto [end, code] = std::from_chars(rest.data(), rest.data() + rest.size(), index);
    if (code != std::errc()) fail(line_, quoted(token) + " is not a face corner");
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    return index;
  }

  void check_coordinates() const {
    if (non_finite_ == 0) return;
    fail(first_non_finite_line_, "non-finite coordinate: " + vertex_text(mesh_, first_non_finite_) +
                                     " (counting from 0); " +
                                     count_text(non_finite_, "such vertex") + " in all");
  }

  void check_indices() const {
    const int n = static_cast<int>(mesh_.vertices.size());
    std::size_t bad = 0;
    std::size_t first = 0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (int v : mesh_.triangles[t]) {
        if (v >= 0 && v < n) continue;
        if (bad++ == 0) first = t;
        break;
      }
    }
    if (bad == 0) return;
    fail(triangle_lines_[first],
         "index out of range: triangle " + std::to_string(first) +
             " (counting from 0) refers to a vertex that the file does not have (it has " +
             std::to_string(n) + "); " + count_text(bad, "such triangle") + " in all");
  }

  static std::string quoted(std::string_view token) {
    return "\"" + std::string(token.substr(0, 40)) + "\"";
  }

  [[noreturn]] void fail(int line, const std::string& what) const {
    throw Error(ErrorCode::invalid_input, source_ + ":" + std::to_string(line) + ": " + what);
  }

  std::string_view rest_;
  const std::string& source_;
  TriangleMesh mesh_;
  std::vector<int> triangle_lines_;
  int line_ = 0;
  int next_line_ = 1;
  std::size_t non_finite_ = 0;
  int first_non_finite_ = 0;
  int first_non_finite_line_ = 0;
};

}  // namespace

TriangleMesh parse_obj(std::string_view text, const std::string& source) {
  return ObjParser(text, source).parse();
}

}  // namespace bem
