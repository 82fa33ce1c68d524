#include "siconos.hpp"

#include <algorithm>

#include <siconos/numerics/FrictionContactProblem.h>
#include <siconos/numerics/Friction_cst.h>
#include <siconos/numerics/NonSmoothDrivers.h>
#include <siconos/numerics/NumericsMatrix.h>
#include <siconos/numerics/SolverOptions.h>
#include <siconos/numerics/SparseBlockMatrix.h>

namespace bem {
namespace {

/// The blocks of a problem as Siconos wants them.
class BlockMatrix {
 public:
  BlockMatrix(const FrictionProblem& p, double unit) : blocks_(p.blocks), sbm_(SBM_new()) {
    const int n = p.contacts();
    for (Mat3& block : blocks_) block /= unit;
    for (Mat3& block : blocks_) pointers_.push_back(block.data());
    for (int i = 0; i < n; ++i) sizes_.push_back(static_cast<unsigned>(3 * (i + 1)));
    starts_.assign(p.row_start.begin(), p.row_start.end());
    columns_.assign(p.columns.begin(), p.columns.end());
    sbm_->nbblocks = static_cast<unsigned>(blocks_.size());
    sbm_->block = pointers_.data();
    sbm_->blocknumber0 = sbm_->blocknumber1 = static_cast<unsigned>(n);
    sbm_->blocksize0 = sbm_->blocksize1 = sizes_.data();
    sbm_->filled1 = starts_.size();
    sbm_->filled2 = columns_.size();
    sbm_->index1_data = starts_.data();
    sbm_->index2_data = columns_.data();
    matrix_ = NM_new();
    NM_fill(matrix_, NM_SPARSE_BLOCK, 3 * n, 3 * n, sbm_);
  }
  BlockMatrix(const BlockMatrix&) = delete;
  BlockMatrix& operator=(const BlockMatrix&) = delete;
  ~BlockMatrix() {
    NM_free_not_SBM(matrix_);
    std::free(sbm_);
  }
  NumericsMatrix* get() { return matrix_; }

 private:
  std::vector<Mat3> blocks_;
  std::vector<double*> pointers_;
  std::vector<unsigned> sizes_;
  std::vector<std::size_t> starts_, columns_;
  SparseBlockStructuredMatrix* sbm_;
  NumericsMatrix* matrix_;
};

/// The same as a full matrix.
Eigen::MatrixXd full_matrix(const FrictionProblem& p, double unit) {
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(p.q.size(), p.q.size());
  for (int i = 0; i < p.contacts(); ++i)
    for (int k = p.row_start[i]; k < p.row_start[i + 1]; ++k)
      w.block<3, 3>(3 * i, 3 * p.columns[k]) = p.blocks[k] / unit;
  return w;
}

/// Mean root mean square of the singular values of the own blocks.
double compliance_unit(const FrictionProblem& p) {
  double sum = 0;
  for (int i = 0; i < p.contacts(); ++i)
    for (int k = p.row_start[i]; k < p.row_start[i + 1]; ++k)
      if (p.columns[k] == i) sum += p.blocks[k].norm() / std::sqrt(3.0);
  return sum > 0 ? sum / p.contacts() : 1;
}

}  // namespace

int solve_with_siconos(const FrictionProblem& problem, SiconosMethod method, double tolerance,
                       int max_iterations, Eigen::VectorXd& forces) {
  const double unit = compliance_unit(problem);
  const double length = problem.q.norm() > 0 ? problem.q.norm() : 1;
  Eigen::VectorXd q = problem.q / length, mu = problem.mu;
  Eigen::VectorXd reaction = Eigen::VectorXd::Zero(q.size()), velocity = reaction;
  BlockMatrix blocks(problem, unit);
  Eigen::MatrixXd full;
  FrictionContactProblem p{};
  p.dimension = 3;
  p.numberOfContacts = problem.contacts();
  p.q = q.data();
  p.mu = mu.data();
  p.M = blocks.get();
  const bool newton = method == SiconosMethod::nsn_ac;
  if (newton) {  // wants a matrix that it can factorise
    full = full_matrix(problem, unit);
    p.M = NM_new();
    NM_fill(p.M, NM_DENSE, static_cast<int>(q.size()), static_cast<int>(q.size()), full.data());
  }
  SolverOptions* options =
      solver_options_create(newton ? SICONOS_FRICTION_3D_NSN_AC : SICONOS_FRICTION_3D_NSGS);
  options->iparam[SICONOS_IPARAM_MAX_ITER] = max_iterations;
  options->dparam[SICONOS_DPARAM_TOL] = tolerance;
  fc3d_driver(&p, reaction.data(), velocity.data(), options);
  const int iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
  solver_options_delete(options);
  if (newton) NM_free_not_dense(p.M);
  forces = length / unit * reaction;
  return iterations;
}

}  // namespace bem
