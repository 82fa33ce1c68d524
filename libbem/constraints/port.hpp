#pragma once

#include "base/types.hpp"

#include <array>
#include <vector>

namespace bem {

/// Where a constraint touches a body: some of the body's joint or contact nodes with weights.
struct Port {
  int constraint = 0;  ///< index of the joint or contact
  double sign = 1;     ///< +1 on side a, -1 on side b
  int count = 0;
  std::array<int, 3> slots = {-1, -1, -1};  ///< positions in the body's list of nodes
  std::array<double, 3> weights = {0, 0, 0};
  Mat3 axes = Mat3::Identity();  ///< turns body axes into those of the constraint
};

/// Adds the response of the constraints of `rows` to forces of those of `columns` that one body
/// brings about: out.block<3, 3>(3 row, 3 column) += signs * axes * C * axes^T with the body's
/// nodal `compliance` C in its own axes.
void add_port_compliance(const std::vector<Port>& rows, const std::vector<Port>& columns,
                         const Eigen::MatrixXd& compliance, Eigen::Ref<Eigen::MatrixXd> out);

}  // namespace bem
