#include "model/sampled_targets.hpp"

#include "assembly/mesh_coarseness.hpp"
#include "compress/codec.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

/// What the builders of a compressed model need to know before they see all rows, from a sample.
class SampledBuilders {
 public:
  SampledBuilders(SlabAssembler<float>& assembler, const std::vector<Slab>& slabs,
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

}  // namespace

double least_stiffness(const BodyModel& model) {
  return 2 * model.discretisation.material.shear_modulus /
         (static_cast<double>(model.nodes()) * softness(model.geometry.nodes));
}

AssemblyTargets<float> sampled_targets(SlabAssembler<float>& assembler,
                                       const std::vector<Slab>& slabs, const BodyModel& model,
                                       const PrecomputeOptions& options) {
  constexpr double kOfIngredient = 0.3;  // of the tolerance: G_0 that becomes H_0^{-1} G_0
  constexpr std::size_t kFew = 8;        // slabs, of which one more in memory is worth its time
  const bool tractions = options.loads != Loads::none;
  const bool iterative = options.inverse == InverseKind::iterative;
  SampledBuilders builders(assembler, slabs, options.codec);
  AssemblyTargets<float> targets;
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

}  // namespace bem
