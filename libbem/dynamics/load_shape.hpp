#pragma once

#include "assembly/load_assembler.hpp"
#include "base/state_archive.hpp"

namespace bem {

/// What the inputs of a load are: their tractions on triangles, in body axes. Loads of the same
/// shape on bodies of the same archive act alike.
class LoadShape {
 public:
  LoadShape() = default;
  /// All panels have as many inputs.
  LoadShape(const std::vector<PanelLoad>& panels, Eigen::Index inputs);

  Eigen::Index inputs() const { return inputs_; }
  std::vector<PanelLoad> panels() const;
  /// Whether it is a shape on a mesh of so many triangles. To be asked of one that was restored
  /// before anything else is.
  bool fits(std::size_t triangles) const;
  void visit_state(StateArchive& state) {
    state(inputs_);
    state.resizable(triangles_, corners_, first_, count_, tractions_);
  }
  bool operator==(const LoadShape& other) const;

 private:
  Eigen::Index inputs_ = 0;
  std::vector<int> triangles_, corners_;  ///< by panel; corners -1: constant
  std::vector<int> first_, count_;        ///< by panel: inputs that may have a traction on it
  Eigen::Matrix3Xd tractions_;            ///< of these inputs, panel after panel [Pa]
};

}  // namespace bem
