#include "handover/usda_text.hpp"

#include "base/text.hpp"

#include <charconv>

namespace bem {
namespace {

void append_number(float number, std::string& to) {
  char digits[32];
  to.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

void append_tuple(const double* numbers, std::size_t count, std::string& to) {
  to += '(';
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) to += ", ";
    append_number(static_cast<float>(numbers[i]), to);
  }
  to += ')';
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

std::string usda_tuple(const double* numbers, std::size_t count) {
  std::string out;
  append_tuple(numbers, count, out);
  return out;
}

std::string usda_tuple(const Vec3& v) {
  return usda_tuple(v.data(), 3);
}

std::string usda_array(const std::vector<double>& numbers, std::size_t components) {
  std::string out = "[";
  for (std::size_t i = 0; i < numbers.size(); i += components) {
    if (i > 0) out += ", ";
    if (components > 1)
      append_tuple(numbers.data() + i, components, out);
    else
      append_number(static_cast<float>(numbers[i]), out);
  }
  return out + "]";
}

std::string usda_array(const std::vector<int>& numbers) {
  std::string out = "[";
  for (std::size_t i = 0; i < numbers.size(); ++i)
    out += (i > 0 ? ", " : "") + std::to_string(numbers[i]);
  return out + "]";
}

std::string usda_string(std::string_view text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n')
      out += "\\n";
    else
      out += c;
  }
  return out + "\"";
}

std::string usda_matrix(const RigidPlace& place) {
  std::string out = "( ";
  for (int column = 0; column < 3; ++column) {
    out += '(';
    for (int row = 0; row < 3; ++row) out += to_text(place.rotation(row, column)) + ", ";
    out += "0), ";
  }
  out += '(';
  for (int row = 0; row < 3; ++row) out += to_text(place.translation[row]) + ", ";
  return out + "1) )";
}

std::string usda_identifier(std::string_view text) {
  std::string out = text.empty() || is_digit(text.front()) ? "_" : "";
  for (char c : text) out += is_letter(c) || is_digit(c) ? c : '_';
  return out;
}

std::string UsdaNames::unique(std::string_view text) {
  const std::string name = usda_identifier(text);
  std::string out = name;
  for (int number = 2; !taken_.insert(out).second; ++number)
    out = name + "_" + std::to_string(number);
  return out;
}

}  // namespace bem
