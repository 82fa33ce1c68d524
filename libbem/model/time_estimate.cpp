#include "model/time_estimate.hpp"

#include "algebra/lu.hpp"
#include "base/parallel.hpp"
#include "compress/dense_store.hpp"
#include "kernels/contour.hpp"
#include "mesh/shapes.hpp"
#include "mesh/surface.hpp"
#include "model/memory_estimate.hpp"
#include "model/model_assembly.hpp"

#include <cmath>
#include <ctime>
#include <functional>

namespace bem {
namespace {

/// On all threads of a machine that does nothing else [s]: from CPU time.
double seconds_of(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / thread_count();
}

/// CPU seconds of the machine that bodies were measured on: of a pair of points and lane, of a pair
/// of points of the static kernels, and of a pair of nodes and lane with its compression.
struct Costs {
  double near_point, static_point, pair_of_nodes;
};
constexpr Costs kGalerkin{7.4e-9, 1.9e-7, 2.3e-6}, kCollocation{1.2e-7, 0, 6.5e-7};

/// On one thread of that machine.
double reference_seconds(double nodes, const Discretisation& d, const QuadratureCount& count) {
  const Costs& c = d.is_galerkin() ? kGalerkin : kCollocation;
  const double lanes = LaneLayout(d.scheme, d.history_length).count();
  return lanes * (c.near_point * count.near_points + c.pair_of_nodes * nodes * nodes) +
         c.static_point * count.static_points;
}

/// How many times slower all threads of this machine are, by the matrices of a small body, whose
/// quadrature and whose nodes count as those of others.
/// T: what the codec stores.
template <class T>
double slowness(const PrecomputeOptions& options) {
  constexpr double kCached = 0.82;  // of the time: all of it stays in the cache
  BodyModel model;
  model.geometry = make_geometry(make_surface(icosphere(0, 1), ""), 1);
  model.discretisation = options.discretisation;
  Discretisation& d = model.discretisation;
  d.history_length = std::min(d.history_length, 2);
  d.dt = model.geometry.extent / d.material.shear_speed();
  const int nodes = static_cast<int>(model.nodes());
  const auto measured = [&] {
    const auto assembler = make_slab_assembler<T>(model, assembly_precision(options), false);
    MatrixSlab<T> slab;
    return seconds_of([&] { assembler->assemble(0, nodes, slab); });
  };
  const double seconds = std::min(measured(), measured()),  // the first time allocates
      expected = reference_seconds(nodes, d, count_quadrature(model.geometry.nodes, d));
  return seconds / (kCached * expected);
}

/// Factorisation, inverse and, if asked for, solution for n right-hand sides, for one initial
/// component.
template <class T>
double seconds_of_inversion(double unknowns, bool solution) {
  const auto n = static_cast<Eigen::Index>(std::min(unknowns, 768.0));
  DenseMatrix<T> a = DenseMatrix<T>::Random(n, n), b = DenseMatrix<T>::Random(n, n);
  a.diagonal().array() += T(static_cast<double>(n));
  const double seconds = seconds_of([&] {
    Lu<T> lu(std::move(a));
    if (solution) lu.solve(b);
    a = std::move(lu).invert();
  });
  return seconds * std::pow(unknowns / static_cast<double>(n), 3);
}

double seconds_of_inversions(double nodes, const PrecomputeOptions& o) {
  if (o.inverse != InverseKind::dense) return 0;
  const bool solution = !o.codec.codec->is_sampled();
  double sum = 0;
  for (const InitialComponent& c : o.discretisation.scheme.initial_components())
    sum += c.paired ? seconds_of_inversion<Complex>(3 * nodes, solution)
                    : seconds_of_inversion<double>(3 * nodes, solution);
  return sum;
}

double seconds_per_byte_of_products() {
  constexpr std::size_t kSize = 4096;
  DenseStore<float> matrix(kSize, kSize);
  parallel_for(kSize, [&](std::size_t i) { std::fill_n(matrix.row(i), kSize, 1.0f); });
  const std::vector<double> x(kSize, 1.0);
  std::vector<double> y(kSize, 0.0);
  matrix.multiply_add(x.data(), y.data(), 1);
  return seconds_of([&] { matrix.multiply_add(x.data(), y.data(), 1); }) /
         static_cast<double>(matrix.bytes());
}

/// A step reads the H_k, about half of what is stored; iterative ones H_0 many times.
double seconds_of_growth(const BodyGeometry& geometry, const PrecomputeOptions& o) {
  constexpr double kSteps = 150, kIterations = 30;
  const Discretisation& d = o.discretisation;
  const double lags = static_cast<double>(d.history_length * d.scheme.lag_components().size());
  if (lags == 0 || !o.measure_growth) return 0;
  const double reads = 0.5 * (o.inverse == InverseKind::dense ? 1 : 1 + kIterations / lags);
  return (kSteps + d.history_length) * stored_bytes(geometry, o) * reads *
         seconds_per_byte_of_products();
}

}  // namespace

TimeEstimate estimate_time(const BodyGeometry& geometry, const PrecomputeOptions& options,
                           const QuadratureCount& quadrature) {
  if (options.kind == ModelKind::rigid) return {};
  const auto nodes = static_cast<double>(geometry.nodes.vertices.size());
  const double slower =
      options.codec.codec->is_double() ? slowness<double>(options) : slowness<float>(options);
  return {slower * reference_seconds(nodes, options.discretisation, quadrature),
          seconds_of_inversions(nodes, options), seconds_of_growth(geometry, options)};
}

}  // namespace bem
