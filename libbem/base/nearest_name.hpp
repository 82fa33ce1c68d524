#pragma once

#include <string>
#include <vector>

namespace bem {

/// The one of `names` that `word` is likely a misspelling of; empty if none is near. Near means
/// that it is the first part of the name ("angle" of "angle_deg"), or an edit distance (insertion,
/// deletion, replacement, swap of neighbours; upper and lower case are the same) of at most a third
/// of the longer word.
std::string nearest_name(const std::string& word, const std::vector<std::string>& names);

}  // namespace bem
