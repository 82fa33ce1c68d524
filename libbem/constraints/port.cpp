#include "constraints/port.hpp"

namespace bem {

void add_port_compliance(const std::vector<Port>& rows, const std::vector<Port>& columns,
                         const Eigen::MatrixXd& compliance, Eigen::Ref<Eigen::MatrixXd> out) {
  for (const Port& q : columns)
    for (const Port& p : rows) {
      Mat3 block = Mat3::Zero();
      for (int k = 0; k < p.count; ++k)
        for (int l = 0; l < q.count; ++l)
          block +=
              p.weights[k] * q.weights[l] * compliance.block<3, 3>(3 * p.slots[k], 3 * q.slots[l]);
      out.block<3, 3>(3 * p.constraint, 3 * q.constraint) +=
          p.sign * q.sign * (p.axes * block * q.axes.transpose());
    }
}

}  // namespace bem
