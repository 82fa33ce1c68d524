#pragma once

#include <string>
#include <string_view>

namespace bem {

/// The lines of a text file of a mesh, without comments (from # on), and their words. Lines end
/// with LF, CR LF or CR; a byte order mark at the beginning is skipped.
class TextLines {
 public:
  /// `continued`: a backslash at the end of a line continues it on the next one.
  TextLines(std::string_view text, const std::string& source, bool continued);

  /// Takes the next line; false at the end of the text.
  bool next();
  /// As next(), to a line that has words.
  bool next_filled();
  /// Is there another word in the line?
  bool has_word() const;
  /// The next word of the line, empty at its end.
  std::string_view word();
  /// The next word, which must be a number; not a number and infinity are allowed.
  double number();
  /// Number of the line, from 1; 0 before the first.
  int line() const { return line_; }

  /// Throws ErrorCode::invalid_input "source:line: what".
  [[noreturn]] void fail(const std::string& what) const { fail(line_, what); }
  [[noreturn]] void fail(int line, const std::string& what) const;

 private:
  std::string_view take_piece();

  std::string_view text_;
  const std::string& source_;
  bool continued_;
  std::string current_;    ///< the line
  std::string_view rest_;  ///< what of it has not been taken
  int line_ = 0;
  int next_line_ = 1;
};

/// A piece of a file, short enough for a message.
std::string quoted(std::string_view text);

}  // namespace bem
