#include "recode.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "compress/direct_builder.hpp"
#include "compress/low_rank_builder.hpp"
#include "model/balance.hpp"
#include "model/precompute.hpp"

#include <cmath>

namespace bem {
namespace {

/// Rows of all matrices of a family as builders take them.
class Rows {
 public:
  Rows(const DenseFamily<float>& family, const Slab& slab) : matrices_(family.count()) {
    const auto columns = static_cast<Eigen::Index>(family.columns());
    const Eigen::Index first = 3 * slab.row_begin, count = 3 * slab.row_end - first;
    parallel_for(matrices_.size(), [&](std::size_t k) {
      using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      const float* from = family.matrix(static_cast<int>(k)).row(static_cast<std::size_t>(first));
      matrices_[k] = Eigen::Map<const RowMajor>(from, count, columns);
    });
  }
  std::vector<MatrixView<float>> views() const {
    std::vector<MatrixView<float>> out;
    for (const Eigen::MatrixXf& m : matrices_)
      out.emplace_back(m.data(), m.rows(), m.cols(), Eigen::OuterStride<>(m.rows()));
    return out;
  }

 private:
  std::vector<Eigen::MatrixXf> matrices_;
};

double norm_of(const DenseFamily<float>& family) {
  std::vector<double> rows(family.rows());
  parallel_for(rows.size(), [&](std::size_t i) {
    for (int k = 0; k < family.count(); ++k) {
      const float* row = family.matrix(k).row(i);
      for (std::size_t j = 0; j < family.columns(); ++j)
        rows[i] += static_cast<double>(row[j]) * static_cast<double>(row[j]);
    }
  });
  double sum = 0;
  for (double row : rows) sum += row;
  return std::sqrt(sum);
}

}  // namespace

std::unique_ptr<MatrixFamily> recode(const DenseFamily<float>& family, MatrixForm form,
                                     const std::vector<Vec3>& nodes, const CodecOptions& options,
                                     double& error) {
  std::vector<Slab> slabs;
  std::unique_ptr<FamilyBuilder<float>> builder;
  if (options.codec == Codec::lowrank) {
    slabs = with_form(make_partition(nodes, {}), form);
    const Slab& sample = typical_slab(slabs, form);
    const double quantum = LowRankBuilder::choose_quantum(
        sample, Rows(family, sample).views(), options.tolerance * norm_of(family), true);
    builder = std::make_unique<LowRankBuilder>(slabs, family.count(), quantum, form);
  } else {
    const int count = static_cast<int>(nodes.size());
    slabs = direct_slabs(options, count);
    builder = make_direct_builder<float>(options, count, family.count());
  }
  for (const Slab& slab : slabs) builder->add_rows(Rows(family, slab).views());
  auto out = builder->finish();
  error = builder->error();
  return out;
}

std::vector<NamedFamily> families_of(BodyModel& model) {
  ModelReport::CodecErrors& e = model.report.codec_errors;
  const MatrixForm of_h = model.discretisation.method == SpatialMethod::galerkin
                              ? MatrixForm::symmetric
                              : MatrixForm::general;
  const MatrixForm of_inverse = model.kind == ModelKind::quasistatic ? MatrixForm::general : of_h;
  std::vector<NamedFamily> out = {{"h", of_h, &model.h, &e.h}};
  if (model.g) out.push_back({"g", MatrixForm::general, &model.g, &e.g});
  if (model.stiffness) out.push_back({"stiffness", of_h, &model.stiffness, &e.stiffness});
  const auto add = [&](const char* name, MatrixForm form, auto& families, double& error) {
    for (auto& family : families) out.push_back({name, form, &family, &error});
  };
  add("inverse", of_inverse, model.inverse, e.inverse);
  add("traction_response", MatrixForm::general, model.traction_response, e.traction_response);
  add("initial_h", of_h, model.initial_h, e.initial_h);
  add("initial_g", MatrixForm::general, model.initial_g, e.initial_g);
  return out;
}

const DenseFamily<float>& dense_family(const NamedFamily& named) {
  const auto* dense = dynamic_cast<const DenseFamily<float>*>(named.family->get());
  if (!dense)
    throw Error(ErrorCode::archive,
                "the matrices " + named.name +
                    " are not there in single precision: make the archive with --codec none");
  return *dense;
}

void recode(BodyModel& model, const CodecOptions& given) {
  const CodecOptions options = codec_of_body(model.geometry, model.discretisation.method, given);
  for (const NamedFamily& named : families_of(model)) {
    double error = 0;
    const bool stiffness = named.family == &model.stiffness;
    *named.family = recode(dense_family(named), named.form, model.geometry.nodes.vertices,
                           stiffness ? stiffness_codec(options) : options, error);
    *named.error = std::max(*named.error, error);
  }
  model.codec = options.codec;
  compute_balance(model);
}

}  // namespace bem
