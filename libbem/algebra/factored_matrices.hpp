#pragma once

#include <vector>

#include <Eigen/Core>

namespace bem {

/// Several matrices with a common left factor: X_k = outputs * inputs[k].
struct FactoredMatrices {
  Eigen::MatrixXf outputs;              ///< rows x rank
  std::vector<Eigen::MatrixXf> inputs;  ///< rank x columns

  bool empty() const { return inputs.empty(); }
};

}  // namespace bem
