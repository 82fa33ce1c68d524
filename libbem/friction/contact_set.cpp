#include "friction/contact_set.hpp"

#include <cmath>
#include <numeric>

namespace bem {
namespace {

int root_of(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/// Per contact the number of its set.
std::vector<int> number_sets(const FrictionProblem& problem, int& count) {
  const int n = problem.contacts();
  std::vector<int> parent(n), number(n);
  std::iota(parent.begin(), parent.end(), 0);
  for (int i = 0; i < n; ++i)
    for (int k = problem.row_start[i]; k < problem.row_start[i + 1]; ++k) {
      const int a = root_of(parent, i), b = root_of(parent, problem.columns[k]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  count = 0;
  for (int i = 0; i < n; ++i) number[i] = parent[i] == i ? count++ : number[root_of(parent, i)];
  return number;
}

/// Own-block scales and the change of units.
void make_dimensionless(ContactSet& set) {
  FrictionProblem& p = set.problem;
  const int n = p.contacts();
  set.scale.resize(n);
  set.finite = p.q.allFinite();
  for (int i = 0; i < n; ++i)
    for (int k = p.row_start[i]; k < p.row_start[i + 1]; ++k) {
      set.finite = set.finite && p.blocks[k].allFinite();
      if (p.columns[k] == i)
        set.scale[i] =
            Eigen::Map<const Eigen::Matrix<double, 9, 1>>(p.blocks[k].data()).stableNorm() /
            std::sqrt(3.0);
    }
  const int regular = static_cast<int>((set.scale.array() > 0).count());
  const double mean = regular > 0 ? set.scale.sum() / regular : 1;
  set.displacement_unit = p.q.stableNorm();
  if (set.displacement_unit == 0) set.displacement_unit = 1;
  set.force_unit = set.displacement_unit / mean;
  set.finite = set.finite && std::isfinite(set.force_unit) && std::isfinite(1 / set.force_unit);
  if (!set.finite) return;
  p.q /= set.displacement_unit;
  for (Mat3& block : p.blocks) block /= mean;
  for (double& s : set.scale) s = s > 0 ? s / mean : 1;
}

}  // namespace

std::vector<ContactSet> connected_sets(const FrictionProblem& problem) {
  int count = 0;
  const std::vector<int> number = number_sets(problem, count);
  std::vector<ContactSet> sets(count);
  std::vector<int> local(number.size());
  for (std::size_t i = 0; i < number.size(); ++i) {
    local[i] = static_cast<int>(sets[number[i]].contacts.size());
    sets[number[i]].contacts.push_back(static_cast<int>(i));
  }
  for (ContactSet& set : sets) {
    FrictionProblem& p = set.problem;
    const int n = static_cast<int>(set.contacts.size());
    p.q.resize(3 * n);
    p.mu.resize(n);
    for (int a = 0; a < n; ++a) {
      const int i = set.contacts[a];
      p.q.segment<3>(3 * a) = problem.q.segment<3>(3 * i);
      p.mu[a] = problem.mu[i];
      for (int k = problem.row_start[i]; k < problem.row_start[i + 1]; ++k) {
        p.columns.push_back(local[problem.columns[k]]);
        p.blocks.push_back(problem.blocks[k]);
      }
      p.row_start.push_back(static_cast<int>(p.columns.size()));
    }
    make_dimensionless(set);
  }
  return sets;
}

}  // namespace bem
