#include "scene/location.hpp"

namespace bem {
namespace {

/// Bytes of the UTF-8 sequence at `i`, or 0 where there is none.
std::size_t sequence_length(const std::string& text, std::size_t i) {
  const auto lead = static_cast<unsigned char>(text[i]);
  std::size_t length = 0;
  if (lead < 0x80) length = 1;
  if (lead >= 0xC2 && lead < 0xE0) length = 2;
  if (lead >= 0xE0 && lead < 0xF0) length = 3;
  if (lead >= 0xF0 && lead < 0xF5) length = 4;
  if (i + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((static_cast<unsigned char>(text[i + k]) & 0xC0) != 0x80) return 0;
  return length;
}

std::string escaped_byte(char c) {
  const char* digits = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  return std::string("\\x") + digits[byte >> 4] + digits[byte & 15];
}

}  // namespace

std::string printable(const std::string& text, std::size_t max_bytes) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    if (i >= max_bytes) return out + "...";
    const std::size_t length = sequence_length(text, i);
    const auto byte = static_cast<unsigned char>(text[i]);
    if (length == 0 || byte < 0x20 || byte == 0x7F) {
      out += escaped_byte(text[i++]);
    } else {
      out += text.substr(i, length);
      i += length;
    }
  }
  return out;
}

std::string in_quotes(const std::string& text) {
  return '"' + printable(text, 60) + '"';
}

std::string quoted_list(const std::vector<std::string>& names, std::size_t most) {
  std::string out;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
    out += (i == 0 ? "" : ", ") + in_quotes(names[i]);
  return out + (names.size() > most ? ", ..." : "");
}

std::string pointer_token(const std::string& key) {
  std::string out = "/";
  for (char c : key) {
    if (c == '~')
      out += "~0";
    else if (c == '/')
      out += "~1";
    else
      out += c;
  }
  return out;
}

std::string where(const Location& location) {
  std::string out = location.file;
  if (location.line > 0)
    out += ':' + std::to_string(location.line) + ':' + std::to_string(location.column);
  if (!location.pointer.empty()) out += ": " + printable(location.pointer);
  return out;
}

LocatedError error_at(const Location& location, const std::string& text) {
  return {ErrorCode::invalid_input, location, text};
}

}  // namespace bem
