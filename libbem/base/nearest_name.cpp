#include "base/nearest_name.hpp"

#include <algorithm>

namespace bem {
namespace {

constexpr std::size_t kMinStart = 3;  // letters that a key must share with a longer one

std::string lower_case(std::string word) {
  for (char& c : word)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return word;
}

/// Damerau-Levenshtein distance (restricted) with three rows.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::string nearest_name(const std::string& word, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t smallest = 0;
  for (const std::string& name : names) {
    if (word.size() >= kMinStart && name.compare(0, word.size() + 1, word + '_') == 0) return name;
    const std::size_t longer = std::max(word.size(), name.size());
    const std::size_t shorter = std::min(word.size(), name.size());
    if (longer - shorter > longer / 3) continue;
    const std::size_t distance = edit_distance(lower_case(word), lower_case(name));
    if (distance > longer / 3 || (!nearest.empty() && distance >= smallest)) continue;
    nearest = name;
    smallest = distance;
  }
  return nearest;
}

}  // namespace bem
