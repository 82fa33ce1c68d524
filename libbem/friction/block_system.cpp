#include "friction/block_system.hpp"

#include "algebra/block_lu.hpp"

#include <algorithm>
#include <map>

namespace bem {
namespace {

/// Blocks of a problem that is solved with factorisations at most: 430 MB.
constexpr std::size_t kMostBlocks = 6'000'000;

}  // namespace

BlockSystem::BlockSystem(const FrictionProblem& problem)
    : problem_(problem), group_(problem.contacts()), position_(problem.contacts(), -1) {
  std::map<std::vector<int>, int> groups;  // by the contacts that act on theirs
  for (int i = 0; i < problem.contacts(); ++i) {
    const std::vector<int> row(problem.columns.begin() + problem.row_start[i],
                               problem.columns.begin() + problem.row_start[i + 1]);
    group_[i] = groups.try_emplace(row, static_cast<int>(groups.size())).first->second;
  }
  coupled_.resize(groups.size());
  for (const auto& [row, group] : groups) {
    for (int j : row) coupled_[group].push_back(group_[j]);
    std::sort(coupled_[group].begin(), coupled_[group].end());
    coupled_[group].erase(std::unique(coupled_[group].begin(), coupled_[group].end()),
                          coupled_[group].end());
  }
}

BlockSystem::~BlockSystem() = default;

bool BlockSystem::fits(const FrictionProblem& problem) {
  return problem.blocks.size() <= kMostBlocks;
}

/// Gives every active contact its place, and a factorisation its room.
void BlockSystem::place(const std::vector<int>& active) {
  active_ = active;
  size_.assign(coupled_.size(), 0);
  std::fill(position_.begin(), position_.end(), -1);
  for (int i : active_) position_[i] = size_[group_[i]]++;
  std::vector<int> begin(size_.size() + 1, 0);
  for (std::size_t g = 0; g < size_.size(); ++g) begin[g + 1] = begin[g] + size_[g];
  target_.clear();
  for (int i : active_) target_.push_back(begin[group_[i]] + position_[i]);
}

bool BlockSystem::factorise(const std::vector<int>& active, const std::vector<Mat3>& left,
                            const std::vector<Mat3>& own) {
  place(active);
  if (active_.empty()) return true;
  std::vector<int> unknowns;
  std::vector<std::vector<int>> coupled(coupled_.size());
  for (int size : size_) unknowns.push_back(3 * size);
  for (std::size_t g = 0; g < coupled.size(); ++g)
    if (size_[g] > 0)
      for (int other : coupled_[g])
        if (size_[other] > 0) coupled[g].push_back(other);
  lu_ = std::make_unique<BlockLu>(std::move(unknowns), coupled);
  fill(left, own);
  return lu_->factorise();
}

void BlockSystem::fill(const std::vector<Mat3>& left, const std::vector<Mat3>& own) {
  for (int i : active_)
    for (int k = problem_.row_start[i]; k < problem_.row_start[i + 1]; ++k) {
      const int j = problem_.columns[k];
      if (position_[j] < 0) continue;
      auto block = lu_->block(group_[i], group_[j]).block<3, 3>(3 * position_[i], 3 * position_[j]);
      block.noalias() = left[i] * problem_.blocks[k];
      if (i == j) block += own[i];
    }
}

void BlockSystem::solve(Eigen::VectorXd& b) const {
  if (active_.empty()) return;
  Eigen::VectorXd x(b.size());
  for (std::size_t a = 0; a < active_.size(); ++a)
    x.segment<3>(static_cast<Eigen::Index>(3) * target_[a]) =
        b.segment<3>(static_cast<Eigen::Index>(3 * a));
  lu_->solve(x);
  for (std::size_t a = 0; a < active_.size(); ++a)
    b.segment<3>(static_cast<Eigen::Index>(3 * a)) =
        x.segment<3>(static_cast<Eigen::Index>(3) * target_[a]);
}

}  // namespace bem
