#pragma once

#include <random>
#include <string>

namespace bem_fuzz {

/// An input with one to four changes: bits, bytes, numbers of 1 to 8 bytes that are at the edges of
/// their ranges, pieces that are removed, repeated or moved. The same for the same random numbers.
std::string mutated(std::string input, std::mt19937_64& random);

}  // namespace bem_fuzz
