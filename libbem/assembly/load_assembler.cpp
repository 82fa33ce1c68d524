#include "assembly/load_assembler.hpp"

#include "assembly/galerkin_assembler.hpp"
#include "assembly/row_assembler.hpp"
#include "base/parallel.hpp"

namespace bem {
namespace {

class CollocationLoads : public LoadAssembler {
 public:
  CollocationLoads(const TriangleMesh& mesh, double extent, const Discretisation& discretisation)
      : LoadAssembler(mesh, discretisation), rows_(mesh, extent, discretisation) {}

  std::vector<Eigen::MatrixXd> columns(const std::vector<PanelLoad>& loads) const override {
    const auto n = static_cast<Eigen::Index>(3 * mesh_.vertices.size());
    std::vector<Eigen::MatrixXd> out(layout_.count(),
                                     Eigen::MatrixXd(n, loads.at(0).traction.cols()));
    parallel_for(mesh_.vertices.size(), [&](std::size_t i) {
      thread_local RowAssembler::Workspace work;
      const auto row = rows_.assemble_loads(static_cast<int>(i), loads, work);
      for (int lane = 0; lane < layout_.count(); ++lane)
        out[lane].middleRows<3>(static_cast<Eigen::Index>(3 * i)) = row[lane];
    });
    return out;
  }

 private:
  RowAssembler rows_;
};

class GalerkinLoads : public LoadAssembler {
 public:
  GalerkinLoads(const TriangleMesh& mesh, double extent, const Discretisation& discretisation)
      : LoadAssembler(mesh, discretisation), assembler_(mesh, extent, discretisation) {}

  std::vector<Eigen::MatrixXd> columns(const std::vector<PanelLoad>& loads) const override {
    return assembler_.assemble_loads(loads);
  }

 private:
  GalerkinAssembler assembler_;
};

}  // namespace

std::unique_ptr<LoadAssembler> make_load_assembler(const TriangleMesh& mesh, double extent,
                                                   const Discretisation& discretisation) {
  if (discretisation.is_galerkin())
    return std::make_unique<GalerkinLoads>(mesh, extent, discretisation);
  return std::make_unique<CollocationLoads>(mesh, extent, discretisation);
}

}  // namespace bem
