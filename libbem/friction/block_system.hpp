#pragma once

#include "friction/friction_problem.hpp"

#include <memory>

namespace bem {

class BlockLu;

/// The linear systems of Newton's method for contact: over a subset of the contacts,
///
///     M_ij = left_i W_ij + delta_ij own_i          (3x3 blocks).
///
/// Contacts that act on and are acted on by the same others, as those between the same two bodies,
/// make a dense block: O((3 m)^3) operations for m contacts of one body, far fewer in a heap.
class BlockSystem {
 public:
  explicit BlockSystem(const FrictionProblem& problem);
  ~BlockSystem();

  /// Whether memory and time allow factorisations over all contacts of the problem.
  static bool fits(const FrictionProblem& problem);

  /// Factorises M over the contacts `active` (ascending), of which left and own are used; false if
  /// it is singular.
  bool factorise(const std::vector<int>& active, const std::vector<Mat3>& left,
                 const std::vector<Mat3>& own);

  /// b := M^{-1} b, three values per active contact.
  void solve(Eigen::VectorXd& b) const;

 private:
  void place(const std::vector<int>& active);
  void fill(const std::vector<Mat3>& left, const std::vector<Mat3>& own);

  const FrictionProblem& problem_;
  std::vector<int> group_;                 ///< by contact of the problem
  std::vector<std::vector<int>> coupled_;  ///< groups, by group
  std::vector<int> active_;
  std::vector<int> size_,
      position_;             ///< active contacts by group; by contact its place in it or -1
  std::vector<int> target_;  ///< by active contact: its place in the order of groups
  std::unique_ptr<BlockLu> lu_;
};

}  // namespace bem
