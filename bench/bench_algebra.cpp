#include "algebra/lu.hpp"

#include <benchmark/benchmark.h>

namespace {

/// Factorisation and inverse in place: n^3 multiply-adds, on all threads. A multiply-add is two
/// floating-point operations, a complex one eight.
template <class T>
void lu_inverse(benchmark::State& state) {
  const Eigen::Index n = state.range(0);
  bem::DenseMatrix<T> a = bem::DenseMatrix<T>::Random(n, n);
  a.diagonal().array() += T(static_cast<double>(n));
  for (auto unused : state) a = bem::Lu<T>(std::move(a)).invert();
  const double flops = (sizeof(T) == sizeof(double) ? 2.0 : 8.0) * static_cast<double>(n * n * n);
  state.counters["flop/s"] =
      benchmark::Counter(flops, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK_TEMPLATE(lu_inverse, double)->Arg(1536)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_TEMPLATE(lu_inverse, bem::Complex)
    ->Arg(1536)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
