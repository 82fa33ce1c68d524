#pragma once

#include "contact/friction_problem.hpp"

#include <memory>

namespace bem {

template <class T>
class Lu;

/// The linear systems of Newton's method for contact: over a subset of the contacts,
///
///     M_ij = left_i W_ij + delta_ij own_i          (3x3 blocks).
///
/// Factorised dense, or sparse where few of the contacts act on each other directly (bodies in a
/// heap): O((3 m)^3) operations for m contacts in the dense case.
class BlockSystem {
 public:
  explicit BlockSystem(const FrictionProblem& problem);

  /// Whether memory and time allow factorisations over all contacts of the problem.
  static bool fits(const FrictionProblem& problem);
  ~BlockSystem();

  /// Factorises M over the contacts `active` (ascending), of which left and own are used; false if
  /// it is singular.
  bool factorise(const std::vector<int>& active, const std::vector<Mat3>& left,
                 const std::vector<Mat3>& own);

  /// b := M^{-1} b, three values per active contact.
  void solve(Eigen::VectorXd& b) const;

 private:
  struct Sparse;
  void fill_dense(const std::vector<Mat3>& left, const std::vector<Mat3>& own);
  bool fill_sparse(const std::vector<Mat3>& left, const std::vector<Mat3>& own);

  const FrictionProblem& problem_;
  std::vector<int> active_, position_;  ///< per contact of the problem its place in active_ or -1
  bool analysed_ = false;               ///< the sparsity pattern is that of active_
  std::unique_ptr<Lu<double>> dense_;
  std::unique_ptr<Sparse> sparse_;
};

}  // namespace bem
