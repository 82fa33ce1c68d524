#include "model/energy_families.hpp"

#include "model/energy_matrices.hpp"
#include "model/sampled_targets.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

constexpr double kErrorOfEnergy = 1e-4, kSmallestTolerance = 1e-9;

/// With a codec that is sampled: errors of the matrix are at most this part of what smooth motions
/// make of it, x^T a x >= least x^T x.
std::unique_ptr<MatrixFamily> store_sampled(const BodyModel& model, const Codec& codec,
                                            const Eigen::MatrixXd& a, double least,
                                            double tolerance) {
  const std::vector<Slab> slabs =
      with_form(codec.slabs(model.geometry.nodes.vertices), MatrixForm::symmetric);
  const auto rows_of = [&](const Slab& slab) {
    return Eigen::MatrixXf(
        a.middleRows(3 * slab.row_begin, 3 * (slab.row_end - slab.row_begin)).cast<float>());
  };
  const double size = a.norm(),
               most = kErrorOfEnergy * least / spectral_norm_of_errors(1, a.rows());
  const Slab& sample = typical_slab(slabs, MatrixForm::symmetric);
  const std::vector<Eigen::MatrixXf> rows = {rows_of(sample)};
  const auto builder =
      codec.sampled_builder({slabs,
                             MatrixForm::symmetric,
                             sample,
                             {views(rows), nullptr, {}},
                             std::clamp(most, kSmallestTolerance * size, tolerance * size),
                             true});
  for (const Slab& slab : slabs) builder->add_rows(views(std::vector{rows_of(slab)}));
  return builder->finish();
}

template <class T>
std::unique_ptr<MatrixFamily> store_plainly(const BodyModel& model, const CodecOptions& codec,
                                            const Eigen::MatrixXd& a) {
  const auto builder = make_builder<T>(codec, static_cast<int>(model.nodes()), 1);
  for (const Slab& slab : codec.codec->slabs(model.geometry.nodes.vertices)) {
    const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> rows =
        a.middleRows(3 * slab.row_begin, 3 * (slab.row_end - slab.row_begin)).template cast<T>();
    builder->add_rows({view(rows)});
  }
  return builder->finish();
}

}  // namespace

CodecOptions energy_codec(const CodecOptions& options) {
  return stiffness_codec(options);
}

void add_energies(BodyModel& model, const PrecomputeOptions& options, const Progress& progress) {
  const CodecOptions codec = energy_codec(options.codec);
  const auto store = [&](Eigen::MatrixXd&& a, double least) {
    if (codec.codec->is_sampled())
      return store_sampled(model, *codec.codec, a, least, codec.tolerance);
    return codec.codec->is_double() ? store_plainly<double>(model, codec, a)
                                    : store_plainly<float>(model, codec, a);
  };
  EnergyMatrices energies = energy_matrices(model.geometry, model.discretisation, progress);
  if (progress) progress("compressing the energies", 0);
  model.energy_stiffness = store(std::move(energies.stiffness), least_stiffness(model));
  model.energy_mass = store(std::move(energies.mass),
                            model.geometry.mass.mass / static_cast<double>(model.nodes()));
}

}  // namespace bem
