#pragma once

#include "model/body_model.hpp"

namespace bem {

/// Solves H_0 u = b for one initial component of a model, by columns; of the inertial form up to
/// rigid motions. The model must outlive it.
class InitialSolver {
 public:
  virtual ~InitialSolver() = default;

  /// H_0^{-1} b, from `guess` if that is not empty. Bit-identical for any number of threads and for
  /// any other columns beside one.
  virtual Eigen::MatrixXcd solve(const Eigen::MatrixXcd& b,
                                 const Eigen::MatrixXcd& guess = {}) const = 0;
  /// H_0^{-T} b (not conjugated).
  virtual Eigen::MatrixXcd solve_transposed(const Eigen::MatrixXcd& b) const = 0;

  /// About H_0^{-T} b, and what H_0^T makes of that: b itself if it is exact.
  struct Preconditioned {
    Eigen::MatrixXcd solution, product;
  };
  virtual Preconditioned precondition_transposed(const Eigen::MatrixXcd& b) const = 0;

  /// Of the matrix that a solution reads.
  virtual std::size_t bytes() const = 0;
  virtual bool is_iterative() const = 0;
};

/// By the stored inverse if the model has it, else iteratively with H_0: GMRES with the inverses of
/// diagonal blocks of neighbouring nodes as a right preconditioner. Throws ErrorCode::numerical
/// where that does not converge.
std::unique_ptr<InitialSolver> make_initial_solver(const BodyModel& model, int component);

}  // namespace bem
