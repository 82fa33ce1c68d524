#include "render/obj_template.hpp"

#include "base/error.hpp"
#include "render/obj_words.hpp"

#include <charconv>
#include <map>

namespace bem {
namespace {

constexpr int kNoIndex = -1;
constexpr int kMissing = -2;  ///< a number that refers to nothing

double number_of(std::string_view word) {
  if (!word.empty() && word[0] == '+') word.remove_prefix(1);
  double value = 0;
  std::from_chars(word.data(), word.data() + word.size(), value);
  return value;
}

/// From 0, for the number of a file that has `before` such things before the place.
int index_of(std::string_view word, std::size_t before) {
  int number = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (code != std::errc() || end != word.data() + word.size()) return kMissing;
  if (number > 0) return number - 1;
  const int index = number + static_cast<int>(before);
  return number < 0 && index >= 0 ? index : kMissing;
}

/// "v/vt/vn" in parts, empty ones where the corner has none.
std::array<std::string_view, 3> corner_parts(std::string_view corner) {
  std::array<std::string_view, 3> parts;
  for (std::string_view& part : parts) {
    const std::size_t end = std::min(corner.find('/'), corner.size());
    part = corner.substr(0, end);
    corner.remove_prefix(std::min(end + 1, corner.size()));
  }
  return parts;
}

std::string first_line_end(std::string_view text) {
  const std::size_t at = text.find_first_of("\r\n");
  if (at == text.npos || text[at] == '\n') return "\n";
  return text.substr(at, 2) == "\r\n" ? "\r\n" : "\r";
}

template <class Number>
void append_decimal(std::string& text, Number value) {
  char buffer[40];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

template <class Number>
void append_decimals(std::string& text, const Vec3& v) {
  for (int k = 0; k < 3; ++k) {
    if (k > 0) text += ' ';
    append_decimal(text, static_cast<Number>(v[k]));
  }
}

}  // namespace

class ObjTemplateParser {
 public:
  explicit ObjTemplateParser(std::string_view text) : text_(text), words_(text) {}

  ObjTemplate parse() {
    collect_normals();
    file_normals_ = static_cast<int>(out_.normals_.size());
    out_.line_end_ = first_line_end(text_);
    for (words_ = ObjWords(text_); words_.next();) take_statement();
    keep_until(text_.size());
    for (int& uv : out_.corner_uvs_)
      if (uv >= static_cast<int>(out_.uvs_.size())) uv = kNoIndex;
    return std::move(out_);
  }

 private:
  /// Faces may refer to those that follow.
  void collect_normals() {
    while (words_.next()) {
      if (words_.is("vn")) out_.normals_.push_back({kNoIndex, vector()});
      if (words_.is("v")) ++all_vertices_;
    }
  }

  Vec3 vector() const {
    Vec3 v = Vec3::Zero();
    for (std::size_t k = 0; k < 3 && k + 1 < words_.count(); ++k)
      v[static_cast<Eigen::Index>(k)] = number_of(words_.word(k + 1));
    return v;
  }

  void take_statement() {
    if (words_.is("v")) {
      leave_out({words_.words()[1].begin, words_.words()[3].end});
      add_gap(ObjTemplate::Gap::Kind::vertex);
      ++vertices_;
    } else if (words_.is("vn")) {
      leave_out(words_.lines());
      if (normals_++ == 0) add_gap(ObjTemplate::Gap::Kind::normals);
    } else if (words_.is("vt")) {
      const Vec3 uv = vector();
      out_.uvs_.push_back({uv[0], uv[1]});
    } else if (words_.is("f")) {
      take_corners(1, true);
    } else if (words_.is("surf")) {
      take_corners(5, false);  // after the ranges of its two parameters
    } else if (words_.is("mtllib") && words_.count() > 1) {
      leave_out({words_.words()[1].begin, words_.words().back().end});
      add_gap(ObjTemplate::Gap::Kind::libraries);
      out_.libraries_.emplace_back(words_.from(1));
    }
  }

  void take_corners(std::size_t first, bool of_face) {
    for (std::size_t i = first; i < words_.count(); ++i) {
      const auto parts = corner_parts(words_.word(i));
      if (of_face) out_.corner_uvs_.push_back(uv_of(parts[1]));
      if (!parts[2].empty()) replace_normal(words_.words()[i], parts);
    }
  }

  int uv_of(std::string_view word) const {
    return word.empty() ? kNoIndex : std::max(kNoIndex, index_of(word, out_.uvs_.size()));
  }

  void replace_normal(const ObjWords::Range& corner, const std::array<std::string_view, 3>& parts) {
    const int vertex = index_of(parts[0], vertices_), normal = index_of(parts[2], normals_);
    const auto place = static_cast<std::size_t>(parts[2].data() - text_.data());
    const bool exists =
        vertex >= 0 && vertex < all_vertices_ && normal >= 0 && normal < file_normals_;
    const std::size_t slashes = exists ? 0 : parts[1].empty() ? 2 : 1;
    leave_out({place - slashes, corner.end});
    if (exists) out_.fixed_ += std::to_string(normal_at(vertex, normal) + 1);
  }

  /// The first vertex that has a normal of the file keeps its number.
  int normal_at(int vertex, int normal) {
    PointNormal& own = out_.normals_[normal];
    if (own.point == kNoIndex) own.point = vertex;
    if (own.point == vertex) return normal;
    const auto next = static_cast<int>(out_.normals_.size());
    const auto [pair, added] = pairs_.emplace(std::pair(vertex, normal), next);
    if (added) out_.normals_.push_back({vertex, Vec3(own.direction)});
    return pair->second;
  }

  void keep_until(std::size_t end) {
    out_.fixed_.append(text_.substr(kept_, end - kept_));
    kept_ = end;
  }

  void leave_out(const ObjWords::Range& range) {
    keep_until(range.begin);
    kept_ = range.end;
  }

  void add_gap(ObjTemplate::Gap::Kind kind) { out_.gaps_.push_back({out_.fixed_.size(), kind}); }

  std::string_view text_;
  ObjWords words_;
  ObjTemplate out_;
  std::size_t kept_ = 0;  ///< how far the text has been taken or left out
  std::size_t vertices_ = 0, normals_ = 0;
  int all_vertices_ = 0, file_normals_ = 0;
  std::map<std::pair<int, int>, int> pairs_;  ///< vertex and normal of the file -> one more
};

ObjTemplate::ObjTemplate(std::string_view text) : ObjTemplate(ObjTemplateParser(text).parse()) {}

std::string ObjTemplate::text(const std::vector<Vec3>& vertices, const std::vector<Vec3>& normals,
                              const std::vector<std::string>& libraries) const {
  constexpr std::size_t kPerVertex = 64, kPerNormal = 40;
  require(normals.size() == normals_.size() && libraries.size() == libraries_.size() &&
              gaps_.size() == vertices.size() + libraries.size() + (normals.empty() ? 0 : 1),
          "the parts of an OBJ file fit its template");
  std::string out;
  out.reserve(fixed_.size() + kPerVertex * vertices.size() + kPerNormal * normals.size());
  std::size_t kept = 0, vertex = 0, library = 0;
  for (const Gap& gap : gaps_) {
    out.append(fixed_, kept, gap.at - kept);
    kept = gap.at;
    if (gap.kind == Gap::Kind::vertex) append_decimals<double>(out, vertices[vertex++]);
    if (gap.kind == Gap::Kind::libraries) out += libraries[library++];
    if (gap.kind != Gap::Kind::normals) continue;
    for (const Vec3& n : normals) {
      append_decimals<float>(out += "vn ", n);
      out += line_end_;
    }
  }
  return out.append(fixed_, kept);
}

}  // namespace bem
