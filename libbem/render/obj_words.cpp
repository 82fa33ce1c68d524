#include "render/obj_words.hpp"

#include <algorithm>

namespace bem {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

}  // namespace

ObjWords::ObjWords(std::string_view text) : text_(text) {
  if (text_.substr(0, 3) == "\xEF\xBB\xBF") lines_.end = 3;
}

std::string_view ObjWords::word(std::size_t i) const {
  return text_.substr(words_[i].begin, words_[i].end - words_[i].begin);
}

std::string_view ObjWords::from(std::size_t i) const {
  if (i >= words_.size()) return {};
  return text_.substr(words_[i].begin, words_.back().end - words_[i].begin);
}

/// Appends one line; true if a backslash continues it.
bool ObjWords::take_line() {
  const std::size_t begin = lines_.end;
  contents_end_ = std::min(text_.find_first_of("\r\n", begin), text_.size());
  const std::size_t break_size = text_.substr(contents_end_, 2) == "\r\n" ? 2 : 1;
  lines_.end = std::min(contents_end_ + break_size, text_.size());
  return contents_end_ > begin && text_[contents_end_ - 1] == '\\';
}

bool ObjWords::next() {
  words_.clear();
  lines_.begin = lines_.end;
  if (lines_.begin == text_.size()) return false;
  while (take_line() && lines_.end < text_.size()) {
  }
  const std::string_view lines = text_.substr(lines_.begin, contents_end_ - lines_.begin);
  find_words(lines_.begin + std::min(lines.find('#'), lines.size()));
  return true;
}

/// Behind a backslash and the end of its line; `at` if there is none.
std::size_t ObjWords::skip_continuation(std::size_t at) const {
  if (text_[at] != '\\') return at;
  if (at + 1 == text_.size()) return at + 1;
  if (text_.substr(at + 1, 2) == "\r\n") return at + 3;
  return text_[at + 1] == '\n' || text_[at + 1] == '\r' ? at + 2 : at;
}

void ObjWords::find_words(std::size_t end) {
  bool inside = false;
  for (std::size_t at = lines_.begin; at < end;) {
    const std::size_t behind = is_space(text_[at]) ? at + 1 : skip_continuation(at);
    if (behind > at) {
      inside = false;
      at = behind;
      continue;
    }
    if (!inside) words_.push_back({at, at});
    words_.back().end = ++at;
    inside = true;
  }
}

}  // namespace bem
