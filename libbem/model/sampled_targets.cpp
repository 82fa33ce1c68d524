#include "model/sampled_targets.hpp"

#include "assembly/mesh_coarseness.hpp"
#include "compress/codec.hpp"
#include "model/slab_parts.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

constexpr double kOfIngredient = 0.3;  // of the tolerance: G_0 that becomes H_0^{-1} G_0

/// What the builders of a compressed model need to know before they see all rows, from a sample.
class SampledBuilders {
 public:
  /// `iterative`: H_0 is stored. `least`: eigenvalue of the softest motion that is not rigid [N/m].
  SampledBuilders(SlabAssembler<float>& assembler, const std::vector<Slab>& slabs,
                  const CodecOptions& codec, double stiffness_tolerance, double least,
                  bool iterative)
      : slabs_(slabs),
        of_h_(with_form(slabs, assembler.form())),
        form_(assembler.form()),
        inertial_(assembler.is_inertial()),
        codec_(*codec.codec),
        tolerance_(codec.tolerance) {
    assembler.use_factors(slabs);
    const Slab& typical = typical_slab(slabs_, form_);
    const int last = slabs_.back().row_end;
    if (!inertial_) assembler.assemble(typical.row_begin, typical.row_end, sample_);
    norms_ = assembler.estimate_norms();
    if (!inertial_) return;
    if (norms_.initial_g > 0) {
      // what tractions do at once, by G_0, is most of what they do
      g_part_ = norms_.g / std::hypot(norms_.g, norms_.initial_g);
      norms_.g /= g_part_;
    }
    constexpr double kKept = 0.003, kSmallest = 1e-9;
    stiffness_tolerance_ =
        std::clamp(kKept * least / spectral_norm_of_errors(norms_.stiffness, 3 * last), kSmallest,
                   stiffness_tolerance);
    assembler.allow_errors(errors_of_factors(assembler, 9.0 * last * last, iterative));
    assembler.assemble(typical.row_begin, typical.row_end, sample_);
  }

  /// Norm of G over that which its errors are measured by.
  double g_part() const { return g_part_; }

  /// The sample, which the builders that have been made need no more.
  MatrixSlab<float> take_sample() { return std::move(sample_); }

  std::unique_ptr<FamilyBuilder<float>> h() const {
    return builder(h_parts(sample_), norms_.h, tolerance_, form_);
  }
  std::unique_ptr<FamilyBuilder<float>> g() const {
    return builder(g_parts(sample_), norms_.g, tolerance_, MatrixForm::general);
  }
  std::unique_ptr<FamilyBuilder<float>> stiffness() const {
    return builder(stiffness_parts(sample_).parts, norms_.stiffness, stiffness_tolerance_, form_);
  }
  /// Of parts of H_0. In the inertial form the errors are relative to the inertia in it, and not to
  /// the stiffness, of which soft motions feel but a small part.
  std::unique_ptr<FamilyBuilder<float>> initial_h(int first, int count) const {
    return builder(initial_h_parts(sample_, first, count).parts,
                   inertial_ ? kOfInertia * norms_.initial_inertia : norms_.initial_h, tolerance_,
                   form_);
  }
  /// Of parts of G_0. `part_of_tolerance`: less than one for what is an ingredient only.
  std::unique_ptr<FamilyBuilder<float>> initial_g(int first, int count,
                                                  double part_of_tolerance) const {
    return builder(initial_g_parts(sample_, first, count).parts, norms_.initial_g,
                   part_of_tolerance * tolerance_, MatrixForm::general);
  }

 private:
  static constexpr double kOfInertia = 0.1;

  /// Small beside those of the codec; matrices have so many entries.
  FarErrors errors_of_factors(const SlabAssembler<float>& assembler, double entries,
                              bool iterative) const {
    constexpr double kShare = 0.1;
    const auto each = [&](double tolerance, double norm, int matrices) {
      return matrices > 0 ? kShare * tolerance * norm / std::sqrt(entries * matrices) : 0;
    };
    const int lags = assembler.lag_count(), initial = assembler.initial_count();
    FarErrors out;
    out.h = each(tolerance_, norms_.h, lags);
    out.initial_inertia = each(kOfInertia * tolerance_, norms_.initial_inertia, initial);
    out.g = each(tolerance_, norms_.g, lags);
    out.initial_g = each((iterative ? 1 : kOfIngredient) * tolerance_, norms_.initial_g, initial);
    out.stiffness = each(stiffness_tolerance_, norms_.stiffness, 1);
    return out;
  }
  std::unique_ptr<FamilyBuilder<float>> builder(const SlabParts<float>& sample, double norm,
                                                double tolerance, MatrixForm form) const {
    const std::vector<Slab>& slabs = form == MatrixForm::symmetric ? of_h_ : slabs_;
    return codec_.sampled_builder(
        {slabs, form, typical_slab(slabs, form_), sample, tolerance * norm, inertial_});
  }

  const std::vector<Slab>& slabs_;
  std::vector<Slab> of_h_;
  MatrixForm form_;
  bool inertial_;  ///< if not, archives stay as they have always been
  const Codec& codec_;
  double tolerance_;
  double g_part_ = 1, stiffness_tolerance_ = 0;
  SlabAssembler<float>::Norms norms_;
  MatrixSlab<float> sample_;
};

}  // namespace

double least_stiffness(const BodyModel& model) {
  return 2 * model.discretisation.material.shear_modulus /
         (static_cast<double>(model.nodes()) * softness(model.geometry.nodes));
}

AssemblyTargets<float> sampled_targets(SlabAssembler<float>& assembler,
                                       const std::vector<Slab>& slabs, const BodyModel& model,
                                       const PrecomputeOptions& options) {
  constexpr std::size_t kFew = 8;  // slabs, of which one more in memory is worth its time
  const bool tractions = options.loads != Loads::none;
  const bool iterative = options.inverse == InverseKind::iterative;
  SampledBuilders builders(assembler, slabs, options.codec,
                           stiffness_codec(options.codec).tolerance, least_stiffness(model),
                           iterative);
  AssemblyTargets<float> targets;
  if (model.has_history()) targets.h = builders.h();
  if (model.has_history() && tractions) targets.g = builders.g();
  targets.g_part = builders.g_part();
  if (assembler.is_inertial()) targets.stiffness = builders.stiffness();
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

}  // namespace bem
