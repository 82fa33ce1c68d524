#include "model/precompute.hpp"

#include "base/error.hpp"
#include "compress/direct_builder.hpp"
#include "compress/low_rank_builder.hpp"
#include "model/balance.hpp"
#include "model/growth.hpp"
#include "model/initial_inverse.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

/// |H_0 W + s^2 Q_0| relative to |H_0|: rotation is not imposed, so this measures the quadrature.
class RotationResidual {
 public:
  explicit RotationResidual(const BodyModel& model) : model_(model) {
    const auto n = static_cast<Eigen::Index>(model.nodes());
    turns_.resize(3 * n, 3);
    for (Eigen::Index i = 0; i < n; ++i)
      turns_.middleRows<3>(3 * i) = cross_matrix(model.geometry.nodes.vertices[i]).transpose();
  }

  /// Takes the rows of H_0 of a slab, whose body forces are known.
  template <class T>
  void add(const MatrixSlab<T>& slab) {
    const InitialComponent& c = model_.discretisation.scheme.initial_components()[0];
    const Complex s = c.eigenvalue / model_.discretisation.dt;
    Eigen::MatrixXcd moved = (slab.initial_h[0] * turns_).template cast<Complex>();
    if (c.paired) moved.imag() = slab.initial_h[1] * turns_;
    moved += s * s *
             model_.initial_body_force[0].block(3 * slab.first, 3, 3 * (slab.last - slab.first), 3);
    largest_ = std::max(largest_, moved.cwiseAbs().maxCoeff());
  }
  double value() const { return largest_ / model_.geometry.extent; }

 private:
  const BodyModel& model_;
  Eigen::MatrixXd turns_;
  double largest_ = 0;
};

template <class T>
std::vector<MatrixView<T>> views(
    const std::vector<Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>>& matrices) {
  std::vector<MatrixView<T>> out;
  for (const auto& m : matrices)
    out.emplace_back(m.data(), m.rows(), m.cols(), Eigen::OuterStride<>(m.rows()));
  return out;
}

/// What the slabs of the matrices become.
template <class T>
struct Builders {
  std::unique_ptr<FamilyBuilder<T>> h, g;
  std::vector<std::unique_ptr<LowRankBuilder>> initial_g;  ///< compressed models only
};

/// Where one initial component's parts are among the parts of lag 0.
template <class F>
void for_each_initial(const Scheme& scheme, const F& f) {
  int part = 0;
  for (std::size_t i = 0; i < scheme.initial_components().size(); ++i) {
    const bool paired = scheme.initial_components()[i].paired;
    f(i, part, paired);
    part += paired ? 2 : 1;
  }
}

/// Assembles all slabs and gives them to the builders; the dense matrices of lag 0 are filled.
template <class T>
void assemble_all(SlabAssembler<T>& assembler, BodyModel& model, const std::vector<Slab>& slabs,
                  Builders<T>& builders, std::vector<InitialMatrix>& initial_h,
                  std::vector<InitialMatrix>& initial_g, const Progress& progress) {
  MatrixSlab<T> slab;
  RotationResidual rotation(model);
  const double nodes = static_cast<double>(model.nodes());
  for (const Slab& s : slabs) {
    if (progress) progress("assembly", s.row_begin / nodes);
    assembler.assemble(s.row_begin, s.row_end, slab);
    rotation.add(slab);
    builders.h->add_rows(views(slab.h));
    if (builders.g) builders.g->add_rows(views(slab.g));
    for_each_initial(model.discretisation.scheme, [&](std::size_t i, int part, bool paired) {
      const auto second = [&](const std::vector<Eigen::MatrixXd>& parts) {
        return paired ? &parts[part + 1] : nullptr;
      };
      const Eigen::Index row = 3 * s.row_begin;
      initial_h[i].set_rows(row, slab.initial_h[part], second(slab.initial_h));
      if (!initial_g.empty())
        initial_g[i].set_rows(row, slab.initial_g[part], second(slab.initial_g));
      if (builders.initial_g.empty()) return;
      std::vector<Eigen::MatrixXf> parts = {slab.initial_g[part].template cast<float>()};
      if (paired) parts.emplace_back(slab.initial_g[part + 1].template cast<float>());
      builders.initial_g[i]->add_rows(views(parts));
    });
  }
  model.report.row_sum_residual = assembler.row_sum_residual();
  model.report.rotation_residual = rotation.value();
}

std::vector<InitialMatrix> initial_matrices(const BodyModel& model) {
  std::vector<InitialMatrix> out;
  for (const InitialComponent& c : model.discretisation.scheme.initial_components())
    out.emplace_back(static_cast<Eigen::Index>(3 * model.nodes()), c.paired);
  return out;
}

/// Far panels in single precision where neither storage nor tolerance asks for more.
AssemblyPrecision assembly_precision(const PrecomputeOptions& options) {
  const bool single =
      (options.codec.codec != Codec::none || options.precision == Precision::float32) &&
      options.discretisation.quadrature_tolerance >= 1e-6;
  return single ? AssemblyPrecision::single : AssemblyPrecision::full;
}

/// The family of a builder that has all rows, and the error of it.
template <class T>
std::unique_ptr<MatrixFamily> finish(FamilyBuilder<T>& builder, double& error) {
  auto family = builder.finish();
  error = builder.error();
  return family;
}

template <class T>
void compute_directly(BodyModel& model, const PrecomputeOptions& options,
                      const Progress& progress) {
  const int n = static_cast<int>(model.nodes());
  SlabAssembler<T> assembler(model, assembly_precision(options), options.tractions);
  Builders<T> builders;
  builders.h = make_direct_builder<T>(options.codec, n, assembler.lag_count());
  if (options.tractions)
    builders.g = make_direct_builder<T>(options.codec, n, assembler.lag_count());
  std::vector<InitialMatrix> h = initial_matrices(model), g;
  if (options.tractions) g = initial_matrices(model);
  assemble_all(assembler, model, direct_slabs(options.codec, n), builders, h, g, progress);
  ModelReport::CodecErrors& errors = model.report.codec_errors;
  model.h = finish(*builders.h, errors.h);
  if (builders.g) model.g = finish(*builders.g, errors.g);
  for (std::size_t i = 0; i < h.size(); ++i)
    invert_dense(model, std::move(h[i]), options.tractions ? &g[i] : nullptr, options.codec,
                 progress);
}

/// What the builders of a compressed model need to know before they see all rows, from a sample.
class CompressedBuilders {
 public:
  CompressedBuilders(SlabAssembler<float>& assembler, const std::vector<Slab>& slabs,
                     double tolerance)
      : slabs_(slabs), slab_(slabs[slabs.size() / 2]), tolerance_(tolerance) {
    norms_ = assembler.estimate_norms();
    assembler.assemble(slab_.row_begin, slab_.row_end, sample_);
  }

  std::unique_ptr<LowRankBuilder> h() const { return builder(sample_.h, norms_.h, tolerance_); }
  std::unique_ptr<LowRankBuilder> g() const { return builder(sample_.g, norms_.g, tolerance_); }
  /// Of parts of G_0, which is an ingredient only: more accurate.
  std::unique_ptr<LowRankBuilder> initial_g(int first, int count) const {
    constexpr double kOfTolerance = 0.3;
    std::vector<Eigen::MatrixXf> parts;
    for (int i = first; i < first + count; ++i)
      parts.emplace_back(sample_.initial_g[i].cast<float>());
    return builder(parts, norms_.initial_g, kOfTolerance * tolerance_);
  }

 private:
  std::unique_ptr<LowRankBuilder> builder(const std::vector<Eigen::MatrixXf>& sample, double norm,
                                          double tolerance) const {
    return std::make_unique<LowRankBuilder>(
        slabs_, static_cast<int>(sample.size()),
        LowRankBuilder::choose_quantum(slab_, views(sample), tolerance * norm));
  }

  const std::vector<Slab>& slabs_;
  const Slab& slab_;
  double tolerance_;
  SlabAssembler<float>::Norms norms_;
  MatrixSlab<float> sample_;
};

void compute_compressed(BodyModel& model, const PrecomputeOptions& options,
                        const Progress& progress) {
  SlabAssembler<float> assembler(model, assembly_precision(options), options.tractions);
  const std::vector<Slab> slabs = make_partition(model.geometry.nodes.vertices, {});
  Builders<float> builders;
  {
    const CompressedBuilders sample(assembler, slabs, options.codec.tolerance);
    builders.h = sample.h();
    if (options.tractions) builders.g = sample.g();
    if (options.tractions)
      for_each_initial(model.discretisation.scheme, [&](std::size_t, int part, bool paired) {
        builders.initial_g.push_back(sample.initial_g(part, paired ? 2 : 1));
      });
  }
  std::vector<InitialMatrix> h = initial_matrices(model), none;
  assemble_all(assembler, model, slabs, builders, h, none, progress);
  ModelReport::CodecErrors& errors = model.report.codec_errors;
  model.h = finish(*builders.h, errors.h);
  if (builders.g) model.g = finish(*builders.g, errors.g);
  for (std::size_t i = 0; i < h.size(); ++i) {
    std::unique_ptr<MatrixFamily> g;
    if (options.tractions) g = builders.initial_g[i]->finish();
    invert_compressed(model, std::move(h[i]), dynamic_cast<const LowRankFamily*>(g.get()),
                      options.codec.tolerance, progress);
  }
}

/// The window that brings the measured growth down to 1. Throws if it would leave nothing of the
/// body's motion.
double automatic_window(const BodyModel& model) {
  constexpr double kLeastLeft = 0.01, kRounding = 1e-6;
  const double growth = model.report.growth;
  if (growth <= 1) return 1;
  const double window = (1 - kRounding) / growth;
  if (std::pow(window, std::max(1.0, model.report.lam)) >= kLeastLeft) return window;
  double edge = 0;
  for (const Triangle& t : model.geometry.nodes.triangles)
    for (int k = 0; k < 3; ++k)
      edge = std::max(edge, (model.geometry.nodes.vertices[t[k]] -
                             model.geometry.nodes.vertices[t[(k + 1) % 3]])
                                .norm());
  const Discretisation& d = model.discretisation;
  throw Error(ErrorCode::numerical,
              "motions grow by a factor of " + std::to_string(growth) +
                  " per step, and a window that prevents it would leave nothing of them; use a "
                  "larger --dt (a shear wave goes " +
                  std::to_string(d.material.shear_speed() * d.dt / edge) +
                  " of the longest edge in a step; sharp edges with a Poisson ratio near 0.5 need "
                  "about 1), a finer mesh or a longer --history, or set --window yourself");
}

}  // namespace

BodyModel precompute(BodyGeometry geometry, const PrecomputeOptions& options,
                     const Progress& progress) {
  BodyModel model;
  model.kind = options.kind;
  model.geometry = std::move(geometry);
  model.discretisation = options.discretisation;
  if (options.kind == ModelKind::rigid) return model;
  model.precision = options.precision;
  model.codec = options.codec.codec;
  model.report.lam =
      traversal_steps(model.geometry, options.discretisation.material, options.discretisation.dt);
  if (options.codec.codec == Codec::lowrank)
    compute_compressed(model, options, progress);
  else if (options.precision == Precision::float32)
    compute_directly<float>(model, options, progress);
  else
    compute_directly<double>(model, options, progress);
  if (progress) progress("static balance", 0);
  compute_balance(model);
  model.window = options.window > 0 ? options.window : 1;
  if (options.measure_growth) {
    if (progress) progress("growth factor", 0);
    model.report.growth = growth_factor(model).factor;
    if (options.window == 0) model.window = automatic_window(model);
  }
  return model;
}

MemoryEstimate precompute_memory(std::size_t nodes, const PrecomputeOptions& options) {
  if (options.kind == ModelKind::rigid) return {};
  const Scheme& scheme = options.discretisation.scheme;
  const LaneLayout layout(scheme, options.discretisation.history_length);
  const double square = 9.0 * static_cast<double>(nodes) * static_cast<double>(nodes);
  const double entry = static_cast<double>(bytes_per_entry(options.precision));
  MemoryEstimate e;
  e.stored = square * entry * 2 * layout.count() +
             3.0 * static_cast<double>(nodes) * 6 * 8 * layout.count();
  // lag 0 is complex double while it is factorised; the stored copies replace it one by one
  const double lags = square * entry * 2 * (layout.count() - layout.initial);
  const double initial = square * 16 * 2 * static_cast<double>(scheme.initial_components().size());
  const double at_rest = square * 8 * 2;
  e.peak = std::max(lags + initial + at_rest, e.stored + square * 16);
  return e;
}

}  // namespace bem
