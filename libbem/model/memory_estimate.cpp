#include "model/memory_estimate.hpp"

#include "base/parallel.hpp"
#include "model/energy_matrices.hpp"
#include "model/galerkin_slabs.hpp"
#include "model/model_assembly.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

struct Counts {
  double lags = 0, parts = 0;  ///< matrices of lags >= 1 and parts of lag 0, of H alone
  double kinds = 1;            ///< H, or H and G
};

Counts counts_of(const PrecomputeOptions& o) {
  const LaneLayout layout(o.discretisation.scheme, o.discretisation.history_length);
  return {static_cast<double>(layout.count() - layout.initial), static_cast<double>(layout.initial),
          o.loads == Loads::none ? 1.0 : 2.0};
}

double square(const BodyGeometry& g) {
  const double n = 3.0 * static_cast<double>(g.nodes.vertices.size());
  return n * n;
}

/// Body forces of accelerations and rotation, and the balance matrices, in double precision.
double small_bytes(const BodyGeometry& g, const PrecomputeOptions& o) {
  const Counts c = counts_of(o);
  return 3.0 * static_cast<double>(g.nodes.vertices.size()) * 6 * 8 *
         (2 * (c.lags + c.parts) + c.kinds);
}

/// Bytes that numbers of lag 0 take while they are factorised: complex ones count twice.
double initial_bytes(const BodyGeometry& g, const PrecomputeOptions& o) {
  double bytes = 0;
  for (const InitialComponent& c : o.discretisation.scheme.initial_components())
    bytes += square(g) * (c.paired ? 16 : 8);
  return bytes;
}

/// Rows that the Galerkin method assembles together.
double row_buffer_bytes(const BodyGeometry& g, const PrecomputeOptions& o) {
  if (!o.discretisation.is_galerkin()) return 0;
  return galerkin_row_bytes(static_cast<int>(g.nodes.vertices.size()),
                            LaneLayout(o.discretisation.scheme, o.discretisation.history_length),
                            assembly_precision(o));
}

/// A share of what a codec leaves of H and of G, by columns that carry loads.
double share_of_kinds(const PrecomputeOptions& o, double nodes) {
  const double of_h = o.discretisation.is_galerkin() ? 0.35 : 0.55;  // symmetric, and not
  const double loaded = o.loads == Loads::none ? 0
                        : o.loads == Loads::some
                            ? static_cast<double>(o.loaded_nodes.size()) / nodes
                            : 1;
  return of_h + (1 - of_h) * loaded;
}

/// What codec "lowrank" leaves, from a fit to 740 archives, nine tenths of which it meets to 20 %.
/// Up to some number of nodes entries are independent of each other, beyond it they are not; and
/// as a wave passes by within some steps, so many lags of an entry are not small.
double compressed_bytes(const BodyGeometry& g, const PrecomputeOptions& o) {
  struct Fit {
    double steps, steps_per_lam, part, nodes, shape;
  };
  constexpr Fit kGalerkin{5.6, 1.64, 0.62, 132, 0.57}, kCollocation{2.1, 2.1, 0.66, 185, 0.51};
  constexpr double kUsual = 4, kTables = 1.5e5;  // digits of the tolerance; bytes
  const Discretisation& d = o.discretisation;
  const Fit& fit = d.is_galerkin() ? kGalerkin : kCollocation;
  const double nodes = static_cast<double>(g.nodes.vertices.size()),
               lam = traversal_steps(g, d.material, d.dt),
               steps = std::min(d.history_length + 1.0, fit.steps + fit.steps_per_lam * lam),
               components =
                   static_cast<double>(std::max<std::size_t>(1, d.scheme.lag_components().size())),
               digits = -std::log10(codec_of_body(g, d.method, o.codec).tolerance) / kUsual,
               independent = fit.nodes * std::pow(digits, 1.4) *
                             std::pow(surface_area(g.nodes) / (g.extent * g.extent), fit.shape);
  return kTables + fit.part * std::pow(digits, 0.6) * share_of_kinds(o, nodes) * components *
                       steps * 2 * 9 * sizeof(float) * nodes * nodes / (1 + nodes / independent);
}

/// Symmetric matrices without lags, stored as they are but for what is far apart.
double compressed_energy_bytes(const BodyGeometry& g, const PrecomputeOptions& o) {
  return o.energies ? square(g) * sizeof(float) : 0;
}

constexpr double kProgram = 4.5e7;  ///< what the program takes beside its matrices

double bytes_of_entry(const PrecomputeOptions& o) {
  return o.codec.codec->is_double() ? sizeof(double) : sizeof(float);
}

/// The rows of all matrices that are assembled before they are stored, with one more copy of the
/// parts of lag 0, which are in double precision.
double slab_bytes(const BodyGeometry& g, const PrecomputeOptions& o,
                  const std::vector<Slab>& slabs) {
  const Counts c = counts_of(o);
  const double entry = bytes_of_entry(o);
  double rows = 0;
  for (const Slab& s : slabs) rows = std::max(rows, 3.0 * (s.row_end - s.row_begin));
  return rows * 3.0 * static_cast<double>(g.nodes.vertices.size()) *
         (c.kinds * (entry * c.lags + sizeof(double) * c.parts) + entry * c.parts);
}

double compressed_peak(const BodyGeometry& g, const PrecomputeOptions& o, double stored) {
  constexpr double kCopies = 2;  // of the numbers of a block while its bases are found
  constexpr double kTogether = 8;
  const Counts c = counts_of(o);
  const double n = 3.0 * static_cast<double>(g.nodes.vertices.size());
  const std::vector<Slab> slabs = o.codec.codec->slabs(g.nodes.vertices);
  double widest = 0;
  for (const Slab& s : slabs)
    for (const NodeBlock& b : s.blocks) widest = std::max(widest, 9.0 * b.rows() * b.columns());
  const double rows = kTogether * n * 5 * 4 * (c.lags + c.parts + 4);  // of the assembler
  const double work = thread_count() * (kCopies * 4 * widest * c.lags + rows);
  const double dense = o.inverse == InverseKind::dense ? initial_bytes(g, o) : 0;
  return kProgram + stored + dense + slab_bytes(g, o, slabs) + work + row_buffer_bytes(g, o);
}

/// Of assembly and inversion.
double peak_of_steps(const BodyGeometry& g, const PrecomputeOptions& o, double stored) {
  if (o.codec.codec->is_sampled()) return compressed_peak(g, o, stored);
  const Counts c = counts_of(o);
  const double entry = bytes_of_entry(o);
  // lag 0 is double while it is factorised; the stored copies replace it one by one
  const double lags = square(g) * entry * c.kinds * c.lags;
  const double initial = o.inverse == InverseKind::dense ? initial_bytes(g, o) * c.kinds : 0;
  const double slab = slab_bytes(g, o, o.codec.codec->slabs(g.nodes.vertices));
  return kProgram + small_bytes(g, o) +
         std::max(lags + initial + square(g) * entry * c.parts + row_buffer_bytes(g, o) + slab,
                  stored);
}

}  // namespace

double stored_bytes(const BodyGeometry& g, const PrecomputeOptions& o) {
  if (o.kind == ModelKind::rigid) return 0;
  if (o.codec.codec->is_sampled())
    return compressed_bytes(g, o) + compressed_energy_bytes(g, o) + small_bytes(g, o);
  const Counts c = counts_of(o);
  const bool inertial = c.lags > 0 && o.discretisation.is_galerkin();
  return small_bytes(g, o) +
         o.codec.codec->expected_bytes(
             square(g) * (c.kinds * (c.lags + c.parts) + (inertial ? 1 : 0) + (o.energies ? 2 : 0)),
             o.codec);
}

double certain_bytes(const BodyGeometry& g, const PrecomputeOptions& o) {
  return o.codec.codec->is_sampled() ? 0 : stored_bytes(g, o);
}

double peak_bytes(const BodyGeometry& g, const PrecomputeOptions& o, double stored) {
  if (o.kind == ModelKind::rigid) return 0;
  const double steps = peak_of_steps(g, o, stored);
  if (!o.energies) return steps;
  return std::max(steps,
                  kProgram + stored + energy_bytes(static_cast<int>(g.nodes.vertices.size())));
}

}  // namespace bem
