#pragma once

#include "model/slab_assembly.hpp"

#include <utility>
#include <vector>

namespace bem {

/// |H_0 W + s^2 Q_0| relative to |H_0| (M42): rotation is not imposed, so this measures the
/// quadrature.
class RotationResidual {
 public:
  /// `form`: of H_0. The model must outlive it.
  RotationResidual(const BodyModel& model, MatrixForm form);

  /// Takes the rows of H_0 of a slab, each once.
  template <class T>
  void add(const MatrixSlab<T>& slab);
  /// Of the rows that have been added; the body forces must be known.
  double value() const;

 private:
  const BodyModel& model_;
  MatrixForm form_;
  Eigen::MatrixXd turns_;
  Eigen::MatrixXcd moved_;
  std::vector<std::pair<Eigen::Index, Eigen::Index>> known_;  ///< first rows, and how many
  double size_ = 0;
};

}  // namespace bem
