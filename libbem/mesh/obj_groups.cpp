#include "mesh/obj_groups.hpp"

#include "mesh/text_lines.hpp"

#include <set>

namespace bem {
namespace {

/// The names that hold for the faces that follow.
class NamesInForce {
 public:
  explicit NamesInForce(NamedRanges& ranges) : ranges_(ranges) {}

  /// The names of the line hold from `face` on, in place of those before.
  void replace(std::set<std::string> names, std::size_t face) {
    end(face);
    names_ = std::move(names);
    since_ = face;
  }

  void end(std::size_t face) {
    if (face > since_)
      for (const std::string& name : names_) ranges_[name].emplace_back(since_, face);
    names_.clear();
  }

 private:
  NamedRanges& ranges_;
  std::set<std::string> names_;
  std::size_t since_ = 0;
};

std::set<std::string> words_of(TextLines& lines) {
  std::set<std::string> words;
  for (std::string_view word = lines.word(); !word.empty(); word = lines.word())
    words.emplace(word);
  return words;
}

std::set<std::string> one_name(TextLines& lines) {
  std::string name(lines.word());
  for (std::string_view word = lines.word(); !word.empty(); word = lines.word())
    name.append(" ").append(word);
  return {name};
}

}  // namespace

NamedRanges parse_obj_groups(std::string_view text, const std::string& source) {
  NamedRanges ranges;
  NamesInForce groups(ranges), object(ranges), material(ranges);
  TextLines lines(text, source, true);
  std::size_t face = 0;
  while (lines.next()) {
    const std::string_view keyword = lines.word();
    if (keyword == "f") ++face;
    if (keyword == "g") groups.replace(words_of(lines), face);
    if (keyword == "o") object.replace(one_name(lines), face);
    if (keyword == "usemtl") material.replace(one_name(lines), face);
  }
  for (NamesInForce* names : {&groups, &object, &material}) names->end(face);
  return ranges;
}

}  // namespace bem
