#include "mesh/text_lines.hpp"

#include "base/error.hpp"
#include "base/interruption.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace bem {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

}  // namespace

TextLines::TextLines(std::string_view text, const std::string& source, bool continued)
    : text_(text), source_(source), continued_(continued) {
  if (text_.substr(0, 3) == "\xEF\xBB\xBF") text_.remove_prefix(3);
}

/// Up to the end of a line.
std::string_view TextLines::take_piece() {
  const std::size_t end = std::min(text_.find_first_of("\r\n"), text_.size());
  const std::string_view piece = text_.substr(0, end);
  const std::size_t break_size = text_.substr(end, 2) == "\r\n" ? 2 : 1;
  text_.remove_prefix(std::min(end + break_size, text_.size()));
  ++next_line_;
  return piece;
}

bool TextLines::next() {
  if (text_.empty()) return false;
  if (next_line_ % 10000 == 0) check_interruption();
  current_.clear();
  line_ = next_line_;
  for (bool more = true; more && !text_.empty();) {
    std::string_view piece = take_piece();
    more = continued_ && !piece.empty() && piece.back() == '\\';
    if (more) piece.remove_suffix(1);
    current_.append(piece);
    if (more) current_.push_back(' ');
  }
  current_.resize(std::min(current_.find('#'), current_.size()));
  rest_ = current_;
  return true;
}

bool TextLines::next_filled() {
  while (next())
    if (has_word()) return true;
  return false;
}

bool TextLines::has_word() const {
  return !std::all_of(rest_.begin(), rest_.end(), is_blank);
}

std::string_view TextLines::word() {
  while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
  std::size_t n = 0;
  while (n < rest_.size() && !is_blank(rest_[n])) ++n;
  const std::string_view word = rest_.substr(0, n);
  rest_.remove_prefix(n);
  return word;
}

double TextLines::number() {
  const std::string_view text = word();
  std::string_view digits = text;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (code == std::errc::result_out_of_range)
    fail(quoted(text) + " is outside the range of double precision");
  if (code != std::errc() || end != digits.data() + digits.size())
    fail(quoted(text) + " is not a number");
  return value;
}

void TextLines::fail(int line, const std::string& what) const {
  throw Error(ErrorCode::invalid_input, source_ + ":" + std::to_string(line) + ": " + what);
}

std::string quoted(std::string_view text) {
  return "\"" + std::string(text.substr(0, 40)) + "\"";
}

}  // namespace bem
