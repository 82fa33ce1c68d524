#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace bem {

/// The statements of an OBJ file and where their words are in its text. What is a line, a
/// continuation, a comment and a word is the same as in mesh/text_lines.hpp; other than there
/// nothing is copied, so that a text can be written again with some of its words replaced.
class ObjWords {
 public:
  /// Places in the text, the end not included.
  struct Range {
    std::size_t begin = 0, end = 0;
  };

  /// The text must outlive this.
  explicit ObjWords(std::string_view text);

  /// Takes the next statement, which is empty for blank lines and comments; false at the end.
  bool next();
  /// The lines of the statement with their end.
  Range lines() const { return lines_; }
  const std::vector<Range>& words() const { return words_; }
  std::size_t count() const { return words_.size(); }
  std::string_view word(std::size_t i) const;
  /// Does the statement begin with this word?
  bool is(std::string_view keyword) const { return !words_.empty() && word(0) == keyword; }
  /// All from one word to the last one, with what is between them; empty if there is none.
  std::string_view from(std::size_t i) const;

 private:
  bool take_line();
  void find_words(std::size_t end);
  std::size_t skip_continuation(std::size_t at) const;

  std::string_view text_;
  Range lines_;
  std::size_t contents_end_ = 0;  ///< of the last line, without its end
  std::vector<Range> words_;
};

}  // namespace bem
