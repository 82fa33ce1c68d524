#include "dynamics/load_columns.hpp"

#include "base/parallel.hpp"

namespace bem {

InputColumns load_columns(const ElasticSystem& system, const RowAssembler& assembler,
                          const std::vector<RowAssembler::PanelLoad>& loads) {
  const LaneLayout& layout = assembler.layout();
  const Scheme& scheme = assembler.discretisation().scheme;
  const auto n = static_cast<Eigen::Index>(3 * assembler.mesh().vertices.size());
  const Eigen::Index inputs = loads.at(0).traction.cols();
  std::vector<Eigen::MatrixXd> lags(layout.count() - layout.initial, Eigen::MatrixXd(n, inputs));
  std::vector<Eigen::MatrixXcd> initial(scheme.initial_components().size(),
                                        Eigen::MatrixXcd(n, inputs));
  parallel_for(assembler.mesh().vertices.size(), [&](std::size_t i) {
    thread_local RowAssembler::Workspace work;
    const auto row = assembler.assemble_loads(static_cast<int>(i), loads, work);
    const auto first = static_cast<Eigen::Index>(3 * i);
    for (int lane = layout.initial; lane < layout.count(); ++lane)
      lags[lane - layout.initial].middleRows<3>(first) = row[lane];
    int lane = 0;
    for (std::size_t c = 0; c < initial.size(); ++c) {
      const bool paired = scheme.initial_components()[c].paired;
      auto target = initial[c].middleRows<3>(first);
      target = row[lane].cast<Complex>();
      if (paired) target += Complex(0, 1) * row[lane + 1].cast<Complex>();
      lane += paired ? 2 : 1;
    }
  });
  return system.make_columns(std::move(lags), initial);
}

}  // namespace bem
