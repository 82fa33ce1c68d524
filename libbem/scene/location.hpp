#pragma once

#include "base/error.hpp"

#include <cstddef>
#include <string>

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

/// The ErrorCode::invalid_input error with the message `FILE:LINE:COLUMN: POINTER: text`.
Error error_at(const Location& location, const std::string& text);

/// `text` fit for a terminal: control characters and bytes that are not UTF-8 are escaped, and
/// what goes beyond `max_bytes` is replaced by "...".
std::string printable(const std::string& text, std::size_t max_bytes = 200);

/// printable(text) in double quotes, shortened to what a message can hold.
std::string in_quotes(const std::string& text);

/// Calls `read` and adds the place to the message of an Error that it throws.
template <class Read>
auto at_place(const Location& location, const Read& read) {
  try {
    return read();
  } catch (const Error& e) {
    throw Error(e.code(), where(location) + ": " + e.what());
  }
}

/// The same where a mistake of the input is no mistake of a command line: ErrorCode::usage becomes
/// ErrorCode::invalid_input.
template <class Read>
auto at_place_of_input(const Location& location, const Read& read) {
  try {
    return read();
  } catch (const Error& e) {
    const bool usage = e.code() == ErrorCode::usage;
    throw Error(usage ? ErrorCode::invalid_input : e.code(), where(location) + ": " + e.what());
  }
}

}  // namespace bem
