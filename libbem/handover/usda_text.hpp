#pragma once

#include "base/types.hpp"
#include "handover/animated_scene.hpp"

#include <set>
#include <string>
#include <string_view>
#include <vector>

// Words of the text form of USD (Universal Scene Description).

namespace bem {

/// "(x, y, z)": shortest decimals that read back to the same numbers of single precision.
std::string usda_tuple(const double* numbers, std::size_t count);
std::string usda_tuple(const Vec3& v);
/// "[(x, y, z), ...]" of numbers one after another; of one component "[x, ...]".
std::string usda_array(const std::vector<double>& numbers, std::size_t components);
std::string usda_array(const std::vector<int>& numbers);
/// In quotes.
std::string usda_string(std::string_view text);
/// The matrix of a place, for row vectors, in double precision.
std::string usda_matrix(const RigidPlace& place);

/// A text as a name in USD: letters, digits and underscores, no digit at first.
std::string usda_identifier(std::string_view text);

/// Names that differ from each other.
class UsdaNames {
 public:
  /// The text as a name, with a number after it if it is taken.
  std::string unique(std::string_view text);

 private:
  std::set<std::string> taken_;
};

}  // namespace bem
