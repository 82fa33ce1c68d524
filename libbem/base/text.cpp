#include "base/text.hpp"

#include <algorithm>
#include <charconv>

namespace bem {
namespace {

std::string text_of(double value, std::chars_format format, int digits) {
  char buffer[400];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, format, digits).ptr;
  return {buffer, end};
}

}  // namespace

std::string to_text(double value) {
  char buffer[40];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

std::string rounded_text(double value, int digits) {
  return text_of(value, std::chars_format::general, digits);
}

std::string percent_text(double share) {
  return rounded_text(100 * share, share < 0.995 ? 2 : 3) + " %";
}

std::string count_text(std::size_t count, const std::string& unit) {
  const std::string number = std::to_string(count) + " ";
  if (count == 1) return number + unit;
  if (unit.size() >= 6 && unit.substr(unit.size() - 6) == "vertex")
    return number + unit.substr(0, unit.size() - 2) + "ices";
  return number + unit + "s";
}

std::string bytes_text(double bytes) {
  const char* units[] = {"B", "kB", "MB", "GB", "TB"};
  int unit = 0;
  for (; bytes >= 999.5 && unit < 4; ++unit) bytes /= 1000;
  const bool whole = bytes >= 99.95 || unit == 0;
  return (whole ? text_of(bytes, std::chars_format::fixed, 0) : rounded_text(bytes, 3)) + " " +
         units[unit];
}

std::string seconds_text(double seconds) {
  if (seconds < 9.95) return text_of(seconds, std::chars_format::fixed, 1) + " s";
  const auto whole = static_cast<long long>(std::min(seconds, 1e15) + 0.5);
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

}  // namespace bem
