#include "recode.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "model/balance.hpp"
#include "model/precompute.hpp"

#include <cmath>
#include <numeric>

namespace bem {
namespace {

/// Rows [first, last) of nodes of all matrices of a family, in single precision.
std::vector<Eigen::MatrixXf> rows_of(const MatrixFamily& family, int first, int last) {
  std::vector<int> rows(3 * static_cast<std::size_t>(last - first)), columns(family.columns());
  std::iota(rows.begin(), rows.end(), 3 * first);
  std::iota(columns.begin(), columns.end(), 0);
  std::vector<Eigen::MatrixXf> out(static_cast<std::size_t>(family.count()));
  parallel_for(out.size(), [&](std::size_t k) {
    out[k] = family.block(static_cast<int>(k), rows, columns).cast<float>();
  });
  return out;
}

/// Frobenius norm of all matrices together.
double norm_of(const MatrixFamily& family) {
  std::vector<double> nodes(family.rows() / 3);
  parallel_for(nodes.size(), [&](std::size_t i) {
    const int node = static_cast<int>(i);
    for (const Eigen::MatrixXf& m : rows_of(family, node, node + 1))
      nodes[i] += m.cast<double>().squaredNorm();
  });
  return std::sqrt(std::accumulate(nodes.begin(), nodes.end(), 0.0));
}

}  // namespace

std::unique_ptr<MatrixFamily> recode(const MatrixFamily& family, MatrixForm form,
                                     const std::vector<Vec3>& nodes, const CodecOptions& options,
                                     double& error) {
  const Codec& codec = *options.codec;
  std::vector<Slab> slabs = codec.slabs(nodes);
  std::unique_ptr<FamilyBuilder<float>> builder;
  if (codec.is_sampled()) {
    slabs = with_form(slabs, form);
    const Slab& sample = typical_slab(slabs, form);
    const std::vector<Eigen::MatrixXf> rows = rows_of(family, sample.row_begin, sample.row_end);
    builder = codec.sampled_builder({slabs,
                                     form,
                                     sample,
                                     {views(rows), nullptr, {}},
                                     options.tolerance * norm_of(family),
                                     true});
  } else {
    builder = codec.single_builder(options, static_cast<int>(nodes.size()), family.count());
  }
  for (const Slab& slab : slabs) {
    const std::vector<Eigen::MatrixXf> rows = rows_of(family, slab.row_begin, slab.row_end);
    builder->add_rows(views(rows));
  }
  auto out = builder->finish();
  error = builder->error();
  return out;
}

std::vector<NamedFamily> families_of(BodyModel& model) {
  ModelReport::CodecErrors& e = model.report.codec_errors;
  const MatrixForm of_h =
      model.discretisation.is_galerkin() ? MatrixForm::symmetric : MatrixForm::general;
  const MatrixForm of_inverse = model.kind == ModelKind::quasistatic ? MatrixForm::general : of_h;
  std::vector<NamedFamily> out = {{"h", of_h, &model.h, &e.h}};
  if (model.g) out.push_back({"g", MatrixForm::general, &model.g, &e.g});
  if (model.stiffness) out.push_back({"stiffness", of_h, &model.stiffness, &e.stiffness});
  if (model.has_energies()) {
    out.push_back({"energy_stiffness", MatrixForm::symmetric, &model.energy_stiffness, nullptr});
    out.push_back({"energy_mass", MatrixForm::symmetric, &model.energy_mass, nullptr});
  }
  const auto add = [&](const char* name, MatrixForm form, auto& families, double& error) {
    for (auto& family : families) out.push_back({name, form, &family, &error});
  };
  add("inverse", of_inverse, model.inverse, e.inverse);
  add("traction_response", MatrixForm::general, model.traction_response, e.traction_response);
  add("initial_h", of_h, model.initial_h, e.initial_h);
  add("initial_g", MatrixForm::general, model.initial_g, e.initial_g);
  return out;
}

void recode(BodyModel& model, const CodecOptions& given) {
  const CodecOptions options = codec_of_body(model.geometry, model.discretisation.method, given);
  for (const NamedFamily& named : families_of(model)) {
    double error = 0;
    const bool stiffness = named.family == &model.stiffness ||
                           named.family == &model.energy_stiffness ||
                           named.family == &model.energy_mass;
    *named.family = recode(**named.family, named.form, model.geometry.nodes.vertices,
                           stiffness ? stiffness_codec(options) : options, error);
    if (named.error) *named.error = std::max(*named.error, error);
  }
  model.codec = options.codec;
  compute_balance(model);
}

}  // namespace bem
