#pragma once

#include "model/initial_solver.hpp"

namespace bem {

/// H_0^{-1} G_0 of one initial component: displacements (3N) by nodal tractions of the current step
/// (3N, of which some columns may be there only) [m/Pa].
class TractionResponse {
 public:
  virtual ~TractionResponse() = default;

  /// Displacements by tractions `values` at some unknowns, ascending.
  virtual Eigen::VectorXcd multiply(const std::vector<int>& columns,
                                    const Eigen::VectorXcd& values) const = 0;
  /// Entries at the crossings of some rows and columns.
  virtual Eigen::MatrixXcd block(const std::vector<int>& rows,
                                 const std::vector<int>& columns) const = 0;
  /// Its transpose times the columns of x (3N x count).
  virtual Eigen::MatrixXcd multiply_transposed(const Eigen::MatrixXcd& x) const = 0;
  virtual std::size_t bytes() const = 0;
};

/// From the stored H_0^{-1} G_0.
std::unique_ptr<TractionResponse> stored_response(std::shared_ptr<const MatrixFamily> response);

/// From the stored G_0: its columns are solved for when they are asked for, and remembered in
/// single precision as long as there is room for them. The solver must outlive it. Thread safe.
std::unique_ptr<TractionResponse> solved_response(std::shared_ptr<const MatrixFamily> g,
                                                  const InitialSolver& solver);

}  // namespace bem
