#pragma once

#include "base/error.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace bem {

/// A place in an input file, for messages about what was written there.
struct Location {
  std::string file;
  int line = 0;         ///< from 1; 0 if the place has no line
  int column = 0;       ///< from 1, in characters (UTF-8 code points)
  std::string pointer;  ///< JSON pointer (RFC 6901); empty for the whole document
};

/// One step of a JSON pointer: "/" and the key, with "~" and "/" in it escaped.
std::string pointer_token(const std::string& key);

/// `FILE:LINE:COLUMN: POINTER`, without the parts that `location` does not have.
std::string where(const Location& location);

/// An error whose message begins with the place.
class LocatedError : public Error {
 public:
  LocatedError(ErrorCode code, const Location& location, const std::string& text)
      : Error(code, where(location) + ": " + text), file_(location.file) {}
  const std::string& file() const { return file_; }

 private:
  std::string file_;
};

/// The ErrorCode::invalid_input error with the message `FILE:LINE:COLUMN: POINTER: text`.
LocatedError error_at(const Location& location, const std::string& text);

/// `text` fit for a terminal: control characters and bytes that are not UTF-8 are escaped, and
/// what goes beyond `max_bytes` is replaced by "...".
std::string printable(const std::string& text, std::size_t max_bytes = 200);

/// printable(text) in double quotes, shortened to what a message can hold.
std::string in_quotes(const std::string& text);

/// `"a", "b"`, and ", ..." if there are more than `most` names.
std::string quoted_list(const std::vector<std::string>& names, std::size_t most);

/// Calls `read` and adds the place to the message of an Error that it throws, unless the error has
/// a place in the same file, which is nearer to what is wrong.
template <class Read>
auto at_place(const Location& location, const Read& read) {
  try {
    return read();
  } catch (const LocatedError& e) {
    if (e.file() == location.file) throw;
    throw LocatedError(e.code(), location, e.what());
  } catch (const Error& e) {
    throw LocatedError(e.code(), location, e.what());
  }
}

/// The same where a mistake of the input is no mistake of a command line: ErrorCode::usage becomes
/// ErrorCode::invalid_input.
template <class Read>
auto at_place_of_input(const Location& location, const Read& read) {
  return at_place(location, [&] {
    try {
      return read();
    } catch (const LocatedError&) {
      throw;
    } catch (const Error& e) {
      if (e.code() != ErrorCode::usage) throw;
      throw Error(ErrorCode::invalid_input, e.what());
    }
  });
}

}  // namespace bem
