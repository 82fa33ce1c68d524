#include "model/model_assembly.hpp"

#include "base/parallel.hpp"
#include "model/rigid_projection.hpp"
#include "model/rotation_residual.hpp"
#include "model/sampled_targets.hpp"
#include "model/slab_parts.hpp"

#include <algorithm>
#include <optional>

namespace bem {
namespace {

/// The inertia in lag 0 of the distant blocks of a slab: `parts` parts from `part` on.
template <class T>
void set_far_blocks(const MatrixSlab<T>& slab, int part, int parts, InitialMatrix& to) {
  for (const FarBlock& b : slab.far) {
    if (b.inertia.empty()) continue;
    const auto product = [&](int k) {
      return Eigen::MatrixXd((b.inertia.outputs * b.inertia.inputs[k]).template cast<double>());
    };
    const Eigen::MatrixXd real = product(part);
    const Eigen::MatrixXd imaginary = parts > 1 ? product(part + 1) : Eigen::MatrixXd();
    to.set_block(3 * b.rows.begin, 3 * b.columns.begin, real, parts > 1 ? &imaginary : nullptr);
  }
}

/// Assembles all slabs and gives them to their targets.
template <class T>
void assemble_all(SlabAssembler<T>& assembler, BodyModel& model, const std::vector<Slab>& slabs,
                  AssemblyTargets<T>& targets, const Progress& progress) {
  MatrixSlab<T> slab;
  RotationResidual rotation(model, assembler.form());
  const double nodes = static_cast<double>(model.nodes());
  const auto set_dense = [&](std::vector<InitialMatrix>& to, std::size_t i,
                             const std::vector<Eigen::MatrixXd>& from, int part, int parts) {
    if (to.empty()) return;
    const ColumnPlaces& columns = &to == &targets.dense_h ? slab.h_columns : slab.g_columns;
    to[i].set_rows(3 * slab.first, columns, from[part], parts > 1 ? &from[part + 1] : nullptr);
  };
  const auto take_stiffness = [&] {
    if (!targets.stiffness) return;
    const SlabFamily<T> rows = stiffness_parts(slab);
    targets.stiffness->add_parts(rows.parts);
    if (!targets.without_stiffness) return;
    for_each_initial(model.discretisation.scheme,
                     [&](std::size_t, int part, int) { slab.initial_h[part] -= slab.stiffness; });
  };
  for (const Slab& s : slabs) {
    if (progress) progress("assembly", s.row_begin / nodes);
    if (targets.known && targets.known->first == s.row_begin) {
      slab = std::move(*targets.known);
      targets.known.reset();
    } else {
      assembler.assemble(s.row_begin, s.row_end, slab);
    }
    rotation.add(slab);
    if (targets.h) targets.h->add_parts(h_parts(slab));
    if (targets.g) targets.g->add_parts(g_parts(slab));
    take_stiffness();
    for_each_initial(model.discretisation.scheme, [&](std::size_t i, int part, int parts) {
      set_dense(targets.dense_h, i, slab.initial_h, part, parts);
      set_dense(targets.dense_g, i, slab.initial_g, part, parts);
      if (!targets.dense_h.empty()) set_far_blocks(slab, part, parts, targets.dense_h[i]);
      if (!targets.initial_h.empty())
        targets.initial_h[i]->add_parts(initial_h_parts(slab, part, parts).parts);
      if (!targets.initial_g.empty())
        targets.initial_g[i]->add_parts(initial_g_parts(slab, part, parts).parts);
    });
  }
  model.report.row_sum_residual = assembler.row_sum_residual();
  model.report.rotation_residual = rotation.value();
}

/// H(0) of a static model has the rigid motions in its null space. Displacements that are
/// free of them solve the equation with H(0) - [D Q] K Pi as well, which is regular for any regular
/// K: here one that makes both parts about as large.
void make_regular(const BodyModel& model, std::vector<InitialMatrix>& h) {
  if (model.kind != ModelKind::quasistatic) return;
  Eigen::MatrixXd scaled = model.initial_body_force.at(0).real();
  for (Eigen::Index c = 0; c < 6; ++c) {
    const double size = scaled.col(c).cwiseAbs().maxCoeff();
    scaled.col(c) *= (c < 3 ? 1 : model.geometry.extent) / size;
  }
  if (model.discretisation.is_galerkin()) scaled *= h.at(0).real.cwiseAbs().maxCoeff();
  h.at(0).real.noalias() -= scaled * rigid_part(model.geometry.nodes);
  h.at(0).form = MatrixForm::general;
}

/// Takes a builder's family; returns its error.
template <class T>
double finish(FamilyBuilder<T>& builder, std::unique_ptr<MatrixFamily>& family) {
  family = builder.finish();
  return builder.error();
}

/// What the targets of lags, and of lag 0 where it is kept, have become.
template <class T>
void take_families(AssemblyTargets<T>& targets, BodyModel& model) {
  ModelReport::CodecErrors& errors = model.report.codec_errors;
  if (targets.h) errors.h = finish(*targets.h, model.h);
  if (targets.g) errors.g = targets.g_part * finish(*targets.g, model.g);
  if (targets.stiffness) errors.stiffness = finish(*targets.stiffness, model.stiffness);
  const auto take = [](auto& builders, auto& families, double& error) {
    for (auto& builder : builders) {
      families.emplace_back();
      error = std::max(error, finish(*builder, families.back()));
    }
  };
  take(targets.initial_h, model.initial_h, errors.initial_h);
  take(targets.initial_g, model.initial_g, errors.initial_g);
}

template <class T>
void assemble_directly(BodyModel& model, const PrecomputeOptions& options,
                       const Progress& progress) {
  const int n = static_cast<int>(model.nodes());
  const bool tractions = options.loads != Loads::none;
  const auto assembler = make_slab_assembler<T>(model, assembly_precision(options), true);
  AssemblyTargets<T> targets;
  const auto builder = [&](int count) { return make_builder<T>(options.codec, n, count); };
  if (assembler->is_inertial())
    targets.stiffness = make_builder<T>(stiffness_codec(options.codec), n, 1);
  if (model.has_history()) targets.h = builder(assembler->lag_count());
  if (model.has_history() && tractions) targets.g = builder(assembler->lag_count());
  if (options.inverse == InverseKind::dense) {
    targets.dense_h = dense_matrices(model, assembler->form());
    if (tractions) targets.dense_g = dense_matrices(model, MatrixForm::general);
  } else {
    for_each_initial(model.discretisation.scheme, [&](std::size_t, int, int parts) {
      targets.initial_h.push_back(builder(parts));
      if (tractions) targets.initial_g.push_back(builder(parts));
    });
  }
  assemble_all(*assembler, model, options.codec.codec->slabs(model.geometry.nodes.vertices),
               targets, progress);
  take_families(targets, model);
  make_regular(model, targets.dense_h);
  for (std::size_t i = 0; i < targets.dense_h.size(); ++i)
    invert_dense(model, std::move(targets.dense_h[i]), tractions ? &targets.dense_g[i] : nullptr,
                 options.codec, progress);
}

void assemble_compressed(BodyModel& model, const PrecomputeOptions& given,
                         const Progress& progress) {
  PrecomputeOptions options = given;
  options.codec = codec_of_body(model.geometry, options.discretisation.method, given.codec);
  const auto assembler = make_slab_assembler<float>(model, assembly_precision(options), false);
  if (progress) progress("assembly", 0);
  const std::vector<Slab> slabs = options.codec.codec->slabs(model.geometry.nodes.vertices);
  AssemblyTargets<float> targets = sampled_targets(*assembler, slabs, model, options);
  assemble_all(*assembler, model, slabs, targets, progress);
  take_families(targets, model);
  if (options.inverse == InverseKind::iterative) return;
  // a step multiplies H_0^{-1} by D(0) u: slow motions do not grow however coarsely D(0) is stored
  // if both are of the same symmetric matrix
  if (targets.without_stiffness)
    for (InitialMatrix& h : targets.dense_h) h.add(*model.stiffness);
  make_regular(model, targets.dense_h);
  const std::vector<std::unique_ptr<MatrixFamily>> initial_g = std::move(model.initial_g);
  model.initial_g.clear();
  model.report.codec_errors.initial_g = 0;  // not in the model
  for (std::size_t i = 0; i < targets.dense_h.size(); ++i)
    invert_compressed(model, std::move(targets.dense_h[i]),
                      initial_g.empty() ? nullptr : initial_g[i].get(), options.codec, progress);
}

}  // namespace

void assemble_model(BodyModel& model, const PrecomputeOptions& options, const Progress& progress) {
  const Codec& codec = *options.codec.codec;
  if (codec.is_sampled())
    assemble_compressed(model, options, progress);
  else if (codec.is_double())
    assemble_directly<double>(model, options, progress);
  else
    assemble_directly<float>(model, options, progress);
}

AssemblyPrecision assembly_precision(const PrecomputeOptions& options) {
  const bool single =
      !options.codec.codec->is_double() && options.discretisation.quadrature_tolerance >= 1e-6;
  return single ? AssemblyPrecision::single : AssemblyPrecision::full;
}

}  // namespace bem
