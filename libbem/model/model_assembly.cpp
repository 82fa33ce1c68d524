#include "model/model_assembly.hpp"

#include "assembly/mesh_coarseness.hpp"
#include "base/parallel.hpp"
#include "compress/codec.hpp"
#include "model/initial_inverse.hpp"
#include "model/rigid_projection.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

namespace bem {
namespace {

/// |H_0 W + s^2 Q_0| relative to |H_0|: rotation is not imposed, so this measures the quadrature.
class RotationResidual {
 public:
  RotationResidual(const BodyModel& model, MatrixForm form) : model_(model), form_(form) {
    const auto n = static_cast<Eigen::Index>(model.nodes());
    turns_.resize(3 * n, 3);
    for (Eigen::Index i = 0; i < n; ++i)
      turns_.middleRows<3>(3 * i) = cross_matrix(model.geometry.nodes.vertices[i]).transpose();
    moved_ = Eigen::MatrixXcd::Zero(3 * n, 3);
  }

  /// Takes the rows of H_0 of a slab, each once.
  template <class T>
  void add(const MatrixSlab<T>& slab) {
    const bool symmetric = form_ == MatrixForm::symmetric;
    const InitialComponent& c = model_.discretisation.scheme.initial_components()[0];
    const Eigen::Index first = 3 * slab.first, rows = 3 * (slab.last - slab.first);
    const Eigen::Index columns = symmetric ? turns_.rows() - first : turns_.rows();
    const Eigen::Index beyond = symmetric ? columns - rows : 0;
    const auto apply = [&](const Eigen::MatrixXd& part, auto moved) {
      moved.middleRows(first, rows) += part.rightCols(columns) * turns_.bottomRows(columns);
      moved.bottomRows(beyond) +=
          part.rightCols(beyond).transpose() * turns_.middleRows(first, rows);
    };
    apply(slab.initial_h[0], moved_.real());
    if (c.paired) apply(slab.initial_h[1], moved_.imag());
    size_ = std::max(size_, slab.initial_h[0].rightCols(columns).cwiseAbs().maxCoeff());
    known_.emplace_back(first, rows);
  }
  /// Of the rows that have been added; the body forces must be known.
  double value() const {
    const InitialComponent& c = model_.discretisation.scheme.initial_components()[0];
    const Complex s = c.eigenvalue / model_.discretisation.dt;
    double largest = 0;
    for (const auto& [first, rows] : known_)
      largest = std::max(largest, (moved_.middleRows(first, rows) +
                                   s * s * model_.initial_body_force[0].block(first, 3, rows, 3))
                                      .cwiseAbs()
                                      .maxCoeff());
    const double size = model_.discretisation.method == SpatialMethod::galerkin ? size_ : 1;
    return largest / (size * model_.geometry.extent);
  }

 private:
  const BodyModel& model_;
  MatrixForm form_;
  Eigen::MatrixXd turns_;
  Eigen::MatrixXcd moved_;
  std::vector<std::pair<Eigen::Index, Eigen::Index>> known_;  ///< first rows, and how many
  double size_ = 0;
};

template <class T>
MatrixView<T> view(const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>& m) {
  return {m.data(), m.rows(), m.cols(), Eigen::OuterStride<>(m.rows())};
}

template <class T>
std::vector<MatrixView<T>> views(
    const std::vector<Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>>& matrices) {
  std::vector<MatrixView<T>> out;
  for (const auto& m : matrices) out.push_back(view(m));
  return out;
}

/// Where one initial component's parts are among the parts of lag 0.
template <class F>
void for_each_initial(const Scheme& scheme, const F& f) {
  int part = 0;
  for (std::size_t i = 0; i < scheme.initial_components().size(); ++i) {
    const int parts = scheme.initial_components()[i].paired ? 2 : 1;
    f(i, part, parts);
    part += parts;
  }
}

/// What the slabs of the matrices become; what is not wanted is empty.
template <class T>
struct Targets {
  std::unique_ptr<FamilyBuilder<T>> h, g;                               ///< lags, if any
  std::unique_ptr<FamilyBuilder<T>> stiffness;                          ///< of the inertial form
  std::vector<std::unique_ptr<FamilyBuilder<T>>> initial_h, initial_g;  ///< by initial component
  std::vector<InitialMatrix> dense_h, dense_g;  ///< the same, to be inverted
  bool without_stiffness = false;               ///< D(0) is left out of dense_h
  double g_part = 1;                            ///< CompressedBuilders::g_part()
  std::optional<MatrixSlab<T>> known;           ///< a slab that is assembled already
};

/// Assembles all slabs and gives them to their targets.
template <class T>
void assemble_all(SlabAssembler<T>& assembler, BodyModel& model, const std::vector<Slab>& slabs,
                  Targets<T>& targets, const Progress& progress) {
  MatrixSlab<T> slab;
  RotationResidual rotation(model, assembler.form());
  const double nodes = static_cast<double>(model.nodes());
  const auto set_dense = [&](std::vector<InitialMatrix>& to, std::size_t i,
                             const std::vector<Eigen::MatrixXd>& from, int part, int parts) {
    if (!to.empty())
      to[i].set_rows(3 * slab.first, from[part], parts > 1 ? &from[part + 1] : nullptr);
  };
  const auto take_stiffness = [&] {
    if (!targets.stiffness) return;
    const typename MatrixSlab<T>::Matrix rows = slab.stiffness.template cast<T>();
    targets.stiffness->add_rows({view(rows)});
    if (!targets.without_stiffness) return;
    for_each_initial(model.discretisation.scheme,
                     [&](std::size_t, int part, int) { slab.initial_h[part] -= slab.stiffness; });
  };
  const auto add_rows = [&](std::vector<std::unique_ptr<FamilyBuilder<T>>>& to, std::size_t i,
                            const std::vector<Eigen::MatrixXd>& from, int part, int parts) {
    if (to.empty()) return;
    std::vector<typename MatrixSlab<T>::Matrix> rows;
    for (int k = part; k < part + parts; ++k) rows.emplace_back(from[k].template cast<T>());
    to[i]->add_rows(views(rows));
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
    if (targets.h) targets.h->add_rows(views(slab.h));
    if (targets.g) targets.g->add_rows(views(slab.g));
    take_stiffness();
    for_each_initial(model.discretisation.scheme, [&](std::size_t i, int part, int parts) {
      set_dense(targets.dense_h, i, slab.initial_h, part, parts);
      set_dense(targets.dense_g, i, slab.initial_g, part, parts);
      add_rows(targets.initial_h, i, slab.initial_h, part, parts);
      add_rows(targets.initial_g, i, slab.initial_g, part, parts);
    });
  }
  model.report.row_sum_residual = assembler.row_sum_residual();
  model.report.rotation_residual = rotation.value();
}

std::vector<InitialMatrix> dense_matrices(const BodyModel& model, MatrixForm form) {
  std::vector<InitialMatrix> out;
  for (const InitialComponent& c : model.discretisation.scheme.initial_components())
    out.emplace_back(static_cast<Eigen::Index>(3 * model.nodes()), c.paired, form);
  return out;
}

/// H(0) of a quasi-static model has the rigid motions in its null space. Displacements that are
/// free of them solve the equation with H(0) - [D Q] K Pi as well, which is regular for any regular
/// K: here one that makes both parts about as large.
void make_regular(const BodyModel& model, std::vector<InitialMatrix>& h) {
  if (model.kind != ModelKind::quasistatic) return;
  Eigen::MatrixXd scaled = model.initial_body_force.at(0).real();
  for (Eigen::Index c = 0; c < 6; ++c) {
    const double size = scaled.col(c).cwiseAbs().maxCoeff();
    scaled.col(c) *= (c < 3 ? 1 : model.geometry.extent) / size;
  }
  if (model.discretisation.method == SpatialMethod::galerkin)
    scaled *= h.at(0).real.cwiseAbs().maxCoeff();
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
void take_families(Targets<T>& targets, BodyModel& model) {
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
  Targets<T> targets;
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

/// What the builders of a compressed model need to know before they see all rows, from a sample.
class CompressedBuilders {
 public:
  CompressedBuilders(SlabAssembler<float>& assembler, const std::vector<Slab>& slabs,
                     const CodecOptions& codec)
      : slabs_(slabs),
        of_h_(with_form(slabs, assembler.form())),
        form_(assembler.form()),
        inertial_(assembler.is_inertial()),
        codec_(*codec.codec),
        tolerance_(codec.tolerance) {
    const Slab& typical = typical_slab(slabs_, form_);
    assembler.assemble(typical.row_begin, typical.row_end, sample_);
    norms_ = assembler.estimate_norms();
    if (!inertial_ || norms_.initial_g == 0) return;
    // what tractions do at once, by G_0, is most of what they do
    g_part_ = norms_.g / std::hypot(norms_.g, norms_.initial_g);
    norms_.g /= g_part_;
  }

  /// Norm of G over that which its errors are measured by.
  double g_part() const { return g_part_; }

  /// The sample, which the builders that have been made need no more.
  MatrixSlab<float> take_sample() { return std::move(sample_); }

  std::unique_ptr<FamilyBuilder<float>> h() const {
    return builder(sample_.h, norms_.h, tolerance_, form_);
  }
  std::unique_ptr<FamilyBuilder<float>> g() const {
    return builder(sample_.g, norms_.g, tolerance_, MatrixForm::general);
  }
  /// `least`: eigenvalue of the softest motion that is not rigid [N/m].
  std::unique_ptr<FamilyBuilder<float>> stiffness(double tolerance, double least) const {
    constexpr double kKept = 0.003, kSmallest = 1e-9;
    const double spectral = spectral_norm_of_errors(norms_.stiffness, sample_.stiffness.cols());
    return builder({sample_.stiffness.cast<float>()}, norms_.stiffness,
                   std::clamp(kKept * least / spectral, kSmallest, tolerance), form_);
  }
  /// Of parts of H_0. In the inertial form the errors are relative to the inertia in it, and not to
  /// the stiffness, of which soft motions feel but a small part.
  std::unique_ptr<FamilyBuilder<float>> initial_h(int first, int count) const {
    constexpr double kOfInertia = 0.1;
    return builder(parts(sample_.initial_h, first, count),
                   inertial_ ? kOfInertia * norms_.initial_inertia : norms_.initial_h, tolerance_,
                   form_);
  }
  /// Of parts of G_0. `part_of_tolerance`: less than one for what is an ingredient only.
  std::unique_ptr<FamilyBuilder<float>> initial_g(int first, int count,
                                                  double part_of_tolerance) const {
    return builder(parts(sample_.initial_g, first, count), norms_.initial_g,
                   part_of_tolerance * tolerance_, MatrixForm::general);
  }

 private:
  static std::vector<Eigen::MatrixXf> parts(const std::vector<Eigen::MatrixXd>& from, int first,
                                            int count) {
    std::vector<Eigen::MatrixXf> out;
    for (int i = first; i < first + count; ++i) out.emplace_back(from[i].cast<float>());
    return out;
  }
  std::unique_ptr<FamilyBuilder<float>> builder(const std::vector<Eigen::MatrixXf>& sample,
                                                double norm, double tolerance,
                                                MatrixForm form) const {
    const std::vector<Slab>& slabs = form == MatrixForm::symmetric ? of_h_ : slabs_;
    return codec_.sampled_builder(
        {slabs, form, typical_slab(slabs, form_), views(sample), tolerance * norm, inertial_});
  }

  const std::vector<Slab>& slabs_;
  std::vector<Slab> of_h_;
  MatrixForm form_;
  bool inertial_;  ///< if not, archives stay as they have always been
  const Codec& codec_;
  double tolerance_;
  double g_part_ = 1;
  SlabAssembler<float>::Norms norms_;
  MatrixSlab<float> sample_;
};

/// The eigenvalue of D(0) [N/m] of the softest quadratic displacement, bending if the body is
/// slender or thin; a little too large.
double least_stiffness(const BodyModel& model) {
  return 2 * model.discretisation.material.shear_modulus /
         (static_cast<double>(model.nodes()) * softness(model.geometry.nodes));
}

Targets<float> compressed_targets(SlabAssembler<float>& assembler, const std::vector<Slab>& slabs,
                                  const BodyModel& model, const PrecomputeOptions& options) {
  constexpr double kOfIngredient = 0.3;  // of the tolerance: G_0 that becomes H_0^{-1} G_0
  constexpr std::size_t kFew = 8;        // slabs, of which one more in memory is worth its time
  const bool tractions = options.loads != Loads::none;
  const bool iterative = options.inverse == InverseKind::iterative;
  CompressedBuilders builders(assembler, slabs, options.codec);
  Targets<float> targets;
  if (model.has_history()) targets.h = builders.h();
  if (model.has_history() && tractions) targets.g = builders.g();
  targets.g_part = builders.g_part();
  if (assembler.is_inertial())
    targets.stiffness =
        builders.stiffness(stiffness_codec(options.codec).tolerance, least_stiffness(model));
  if (!iterative) {
    targets.dense_h = dense_matrices(model, assembler.form());
    targets.without_stiffness = assembler.is_inertial();
  }
  for_each_initial(model.discretisation.scheme, [&](std::size_t, int part, int parts) {
    if (iterative) targets.initial_h.push_back(builders.initial_h(part, parts));
    if (tractions)
      targets.initial_g.push_back(builders.initial_g(part, parts, iterative ? 1.0 : kOfIngredient));
  });
  if (slabs.size() <= kFew) targets.known = builders.take_sample();
  return targets;
}

void assemble_compressed(BodyModel& model, const PrecomputeOptions& given,
                         const Progress& progress) {
  PrecomputeOptions options = given;
  options.codec = codec_of_body(model.geometry, options.discretisation.method, given.codec);
  const auto assembler = make_slab_assembler<float>(model, assembly_precision(options), false);
  if (progress) progress("assembly", 0);
  const std::vector<Slab> slabs = options.codec.codec->slabs(model.geometry.nodes.vertices);
  Targets<float> targets = compressed_targets(*assembler, slabs, model, options);
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

/// A model whose rows may be assembled.
BodyModel empty_model(const BodyGeometry& geometry, const PrecomputeOptions& options) {
  BodyModel model;
  model.geometry = geometry;
  model.discretisation = options.discretisation;
  model.loads = options.loads;
  model.loaded_nodes = options.loaded_nodes;
  return model;
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

double seconds_per_row(const BodyGeometry& geometry, const PrecomputeOptions& options) {
  constexpr int kFewest = 8, kOfThread = 4;
  constexpr double kShort = 0.5;  // seconds: what the first time allocates matters
  BodyModel model = empty_model(geometry, options);
  const auto assembler = make_slab_assembler<float>(model, assembly_precision(options), false);
  assembler->assemble_alone();
  MatrixSlab<float> slab;
  const int n = static_cast<int>(model.nodes()),
            rows = std::min(n, std::max(kFewest, kOfThread * static_cast<int>(thread_count())));
  const auto seconds_from = [&](int first) {
    const auto start = std::chrono::steady_clock::now();
    assembler->assemble(first, first + rows, slab);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  double seconds = seconds_from((n - rows) / 2);
  const bool has_others = n >= 2 * rows;  // those that are in memory take no time
  if (seconds < kShort && has_others) seconds = std::min(seconds, seconds_from(0));
  return seconds / rows;
}

StoredEstimate sample_compression(const BodyGeometry& geometry, const PrecomputeOptions& options) {
  constexpr std::size_t kSamples = 3;
  constexpr double kOfInverse = 0.7;  // of the bytes of H_0 and G_0
  BodyModel model = empty_model(geometry, options);
  PrecomputeOptions iterative = options;
  iterative.codec = codec_of_body(geometry, options.discretisation.method, options.codec);
  iterative.inverse = InverseKind::iterative;  // H_0 and G_0 are compressed
  const std::vector<Slab> all = options.codec.codec->slabs(geometry.nodes.vertices);
  const std::size_t samples = std::min(kSamples, all.size());
  std::vector<Slab> slabs;
  double rows = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    slabs.push_back(all[(2 * i + 1) * all.size() / (2 * samples)]);
    rows += slabs.back().row_end - slabs.back().row_begin;
  }
  const auto assembler = make_slab_assembler<float>(model, assembly_precision(options), false);
  assembler->assemble_alone();
  auto start = std::chrono::steady_clock::now();
  Targets<float> targets = compressed_targets(*assembler, slabs, model, iterative);
  if (slabs.size() < all.size()) {  // trials take little of the whole, known slabs save little
    targets.known.reset();
    start = std::chrono::steady_clock::now();
  }
  assemble_all(*assembler, model, slabs, targets, nullptr);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  take_families(targets, model);
  double lags = 0, initial = 0, initial_g = 0;
  for (const auto* family : {model.h.get(), model.g.get(), model.stiffness.get()})
    if (family) lags += static_cast<double>(family->bytes());
  for (const auto* families : {&model.initial_h, &model.initial_g})
    for (const auto& family : *families) initial += static_cast<double>(family->bytes());
  for (const auto& family : model.initial_g) initial_g += static_cast<double>(family->bytes());
  const double all_rows = static_cast<double>(model.nodes()) / rows;
  StoredEstimate out{(lags + initial) * all_rows, (lags + initial) * all_rows, seconds * all_rows};
  if (options.inverse == InverseKind::dense) {
    out.bytes = (lags + kOfInverse * initial) * all_rows;
    out.assembly_bytes = (lags + initial_g) * all_rows;
  }
  return out;
}

}  // namespace bem
