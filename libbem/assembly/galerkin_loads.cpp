#include "assembly/galerkin_assembler.hpp"
#include "assembly/galerkin_static.hpp"
#include "base/denormals.hpp"
#include "base/interruption.hpp"
#include "base/parallel.hpp"

#include <algorithm>
#include <memory>

namespace bem {

/// What tractions on triangles have with one triangle of x, by load cases.
template <class T>
struct GalerkinAssembler::LoadPart {
  Eigen::MatrixXd rest;      ///< 18 x cases
  AlignedVector<T> dynamic;  ///< [case][axis][shape of x][padded lane]
};

template <class T>
void GalerkinAssembler::sum_loads(int tx, const std::vector<PanelLoad>& loads,
                                  const LaneTable<T>& lanes, LoadPart<T>& part) const {
  const Material& m = discretisation_.material;
  const Eigen::Index cases = loads.at(0).traction.cols();
  const std::size_t stride = lanes.padded_lanes;
  PairBatch batch;
  const auto scratch = std::make_unique<PairScratch<T>>();
  AlignedVector<T> adjoint_sums(3 * kShapes * 9 * stride),
      uniform_sums(PairSums<T>::kUniform * kShapes * stride);
  part.rest = Eigen::MatrixXd::Zero(18, cases);
  part.dynamic.assign(3 * cases * kShapes * stride, T(0));
  for (const PanelLoad& load : loads) {
    check_interruption();
    Eigen::Matrix<double, 9, Eigen::Dynamic> corners(9, cases);
    for (int b = 0; b < 3; ++b)
      corners.middleRows<3>(3 * b) = (load.corner.value_or(b) == b ? 1.0 : 0.0) * load.traction;
    PairTractions adjoint = PairTractions::Zero();
    add_static_pair(pairs_.quadrature(), m.shear_modulus, m.kappa(), tx, load.triangle, nullptr,
                    adjoint);
    part.rest -= adjoint * corners;
    if (load.triangle == tx) part.rest += 0.5 * mass_matrix(pairs_.quadrature().area(tx)) * corners;
    std::fill(adjoint_sums.begin(), adjoint_sums.end(), T(0));
    std::fill(uniform_sums.begin(), uniform_sums.end(), T(0));
    PairSums<T> sums{};
    sums.lanes = stride;
    for (int a = 0; a < kShapes; ++a) {
      for (int b = 0; b < 3; ++b)
        sums.adjoint[b][a] = &adjoint_sums[(kShapes * b + a) * 9 * stride];
      sums.uniform[a] = &uniform_sums[a * PairSums<T>::kUniform * stride];
    }
    pairs_.add(tx, load.triangle, lanes, batch, *scratch, sums);
    for (int a = 0; a < kShapes; ++a) {
      const T* kernel = load.corner ? sums.adjoint[*load.corner][a] : sums.uniform[a];
      for (Eigen::Index c = 0; c < cases; ++c)
        for (int e = 0; e < 9; ++e) {
          const T factor = static_cast<T>(load.traction(e % 3, c));
          T* to = &part.dynamic[((3 * c + e / 3) * kShapes + a) * stride];
          for (std::size_t lane = 0; lane < stride; ++lane)
            to[lane] += factor * kernel[e * stride + lane];
        }
    }
  }
}

std::vector<Eigen::MatrixXd> GalerkinAssembler::assemble_loads(
    const std::vector<PanelLoad>& loads) const {
  constexpr double kSingle = 1e-6;  // quadrature tolerances that single precision is enough for
  return discretisation_.quadrature_tolerance >= kSingle ? assemble_loads(loads, narrow_table_)
                                                         : assemble_loads(loads, table_.lanes());
}

template <class T>
std::vector<Eigen::MatrixXd> GalerkinAssembler::assemble_loads(const std::vector<PanelLoad>& loads,
                                                               const LaneTable<T>& lanes) const {
  const int count = layout().count();
  const std::size_t stride = lanes.padded_lanes;
  const Eigen::Index cases = loads.at(0).traction.cols();
  std::vector<LoadPart<T>> parts(bases_.size());
  parallel_for(bases_.size(), [&](std::size_t t) {
    const FlushDenormals flush;
    sum_loads(static_cast<int>(t), loads, lanes, parts[t]);
  });
  const auto n = static_cast<Eigen::Index>(3 * mesh_.vertices.size());
  Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(n, cases);
  std::vector<Eigen::MatrixXd> out(count, Eigen::MatrixXd::Zero(n, cases));
  for (std::size_t t = 0; t < bases_.size(); ++t)
    for (std::size_t k = 0; k < bases_[t].vertices.size(); ++k)
      for (int a = 0; a < kShapes; ++a) {
        const double w = bases_[t].weights[k][a];
        const Eigen::Index row = 3 * bases_[t].vertices[k];
        if (w == 0) continue;
        rest.middleRows<3>(row) += w * parts[t].rest.template middleRows<3>(3 * a);
        for (Eigen::Index c = 0; c < cases; ++c)
          for (int i = 0; i < 3; ++i) {
            const T* from = &parts[t].dynamic[((3 * c + i) * kShapes + a) * stride];
            for (int lane = 0; lane < count; ++lane)
              out[lane](row + i, c) += w * static_cast<double>(from[lane]);
          }
      }
  const GalerkinCombination combination(discretisation_, layout());
  std::vector<double> in(count), lane_values(count);
  for (Eigen::Index r = 0; r < n; ++r)
    for (Eigen::Index c = 0; c < cases; ++c) {
      for (int lane = 0; lane < count; ++lane) in[lane] = out[lane](r, c);
      combination.g(rest(r, c), in.data(), lane_values.data());
      for (int lane = 0; lane < count; ++lane) out[lane](r, c) = lane_values[lane];
    }
  return out;
}

}  // namespace bem
