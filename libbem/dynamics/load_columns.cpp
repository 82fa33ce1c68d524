#include "dynamics/load_columns.hpp"

namespace bem {

InputColumns load_columns(const ElasticSystem& system, const LoadAssembler& assembler,
                          const std::vector<PanelLoad>& loads) {
  const LaneLayout& layout = assembler.layout();
  std::vector<Eigen::MatrixXd> lanes = assembler.columns(loads);
  std::vector<Eigen::MatrixXcd> initial;
  int lane = 0;
  for (const InitialComponent& c : assembler.discretisation().scheme.initial_components()) {
    initial.push_back(lanes[lane].cast<Complex>());
    if (c.paired) initial.back() += Complex(0, 1) * lanes[lane + 1].cast<Complex>();
    lane += c.paired ? 2 : 1;
  }
  lanes.erase(lanes.begin(), lanes.begin() + layout.initial);
  return system.make_columns(std::move(lanes), initial);
}

}  // namespace bem
