#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace bem {

/// Numbers 0 .. n - 1 in groups that are united step by step; the lowest number stands for its
/// group.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// False if both were in one group before.
  bool unite(int a, int b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace bem
