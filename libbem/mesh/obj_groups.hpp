#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bem {

/// Ranges [first, end) of faces or triangles by the name of their group, ascending. Ranges of one
/// name may repeat.
using NamedRanges = std::map<std::string, std::vector<std::pair<std::size_t, std::size_t>>>;

/// The faces of an OBJ file, counted in their order, that lines `g`, `o` and `usemtl` give names
/// to: a line holds until the next one of its keyword. `g` may have several names; everything after
/// `o` and `usemtl` is one. A name that stands in several lines is one group. O(bytes) time and
/// memory.
NamedRanges parse_obj_groups(std::string_view text, const std::string& source);

}  // namespace bem
