#include "compress/haar_transform.hpp"

#include "mesh/bisection.hpp"

#include <cmath>

namespace bem {
namespace {

void add_steps(int begin, int end, int leaf, std::vector<HaarStep>& steps) {
  const int count = end - begin;
  if (count <= leaf || count < 2) return;
  const int middle = begin + first_half(count);
  add_steps(begin, middle, leaf, steps);
  add_steps(middle, end, leaf, steps);
  const auto weight = [count](int part) { return std::sqrt(static_cast<double>(part) / count); };
  steps.push_back({begin, middle, weight(middle - begin), weight(end - middle)});
}

void add_ranges(int begin, int end, int leaf, std::vector<int>& firsts) {
  const int count = end - begin;
  if (count <= leaf || count < 2) {
    firsts.push_back(begin);
    return;
  }
  const int middle = begin + first_half(count);
  add_ranges(begin, middle, leaf, firsts);
  add_ranges(middle, end, leaf, firsts);
}

}  // namespace

std::vector<HaarStep> haar_steps(int count, int leaf) {
  std::vector<HaarStep> steps;
  add_steps(0, count, leaf, steps);
  return steps;
}

std::vector<int> haar_ranges(int count, int leaf) {
  std::vector<int> firsts;
  add_ranges(0, count, leaf, firsts);
  firsts.push_back(count);
  return firsts;
}

}  // namespace bem
