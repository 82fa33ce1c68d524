#pragma once

#include <cstddef>
#include <string>

namespace bem {

// Words for messages, the same in every locale.

/// So that the number reads back exactly.
std::string to_text(double value);
/// The same to so many significant digits.
std::string rounded_text(double value, int digits);

/// "2.8 %", "104 %": of a share of one.
std::string percent_text(double share);

/// "1 edge", "3 edges": `unit` in the singular.
std::string count_text(std::size_t count, const std::string& unit);

/// "3.2 GB", "512 MB": decimal units, three digits.
std::string bytes_text(double bytes);
/// "0.8 s", "3 min 20 s", "2 h 5 min".
std::string seconds_text(double seconds);

}  // namespace bem
