#include "dynamics/load_shape.hpp"

#include <algorithm>

namespace bem {
namespace {

/// First and number of the columns from the first to the last that is not zero.
std::pair<Eigen::Index, Eigen::Index> used_columns(const Eigen::Matrix3Xd& traction) {
  Eigen::Index first = 0, end = traction.cols();
  while (end > first && traction.col(end - 1).isZero(0)) --end;
  while (first < end && traction.col(first).isZero(0)) ++first;
  return {first, end - first};
}

}  // namespace

LoadShape::LoadShape(const std::vector<PanelLoad>& panels, Eigen::Index inputs) : inputs_(inputs) {
  Eigen::Index total = 0;
  for (const PanelLoad& panel : panels) {
    const auto [first, count] = used_columns(panel.traction);
    triangles_.push_back(panel.triangle);
    corners_.push_back(panel.corner.value_or(-1));
    first_.push_back(static_cast<int>(first));
    count_.push_back(static_cast<int>(count));
    total += count;
  }
  tractions_.resize(3, total);
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < panels.size(); at += count_[i], ++i)
    tractions_.middleCols(at, count_[i]) = panels[i].traction.middleCols(first_[i], count_[i]);
}

std::vector<PanelLoad> LoadShape::panels() const {
  std::vector<PanelLoad> out;
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < triangles_.size(); at += count_[i], ++i) {
    PanelLoad panel{triangles_[i], Eigen::Matrix3Xd::Zero(3, inputs_), std::nullopt};
    panel.traction.middleCols(first_[i], count_[i]) = tractions_.middleCols(at, count_[i]);
    if (corners_[i] >= 0) panel.corner = corners_[i];
    out.push_back(std::move(panel));
  }
  return out;
}

bool LoadShape::fits(std::size_t triangles) const {
  const std::size_t panels = triangles_.size(), corners = 3 * triangles;
  if (panels > corners || inputs_ < 0 || static_cast<std::size_t>(inputs_) > 3 * corners ||
      corners_.size() != panels || first_.size() != panels || count_.size() != panels)
    return false;
  std::int64_t total = 0;
  for (std::size_t i = 0; i < panels; ++i) {
    if (triangles_[i] < 0 || static_cast<std::size_t>(triangles_[i]) >= triangles ||
        corners_[i] < -1 || corners_[i] > 2 || first_[i] < 0 || count_[i] < 0 ||
        std::int64_t(first_[i]) + count_[i] > inputs_)
      return false;
    total += count_[i];
  }
  return total == tractions_.cols();
}

bool LoadShape::operator==(const LoadShape& other) const {
  return inputs_ == other.inputs_ && triangles_ == other.triangles_ && corners_ == other.corners_ &&
         first_ == other.first_ && count_ == other.count_ && tractions_ == other.tractions_;
}

}  // namespace bem
