#include "assembly/row_assembler.hpp"
#include "support.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace bem_bench;

/// Block rows of a sphere of 642 nodes: all lags of H, G, D and Q, on one thread. T = float is what
/// float32 archives use. `body_s` is the time that all rows of the body would take.
template <class T>
void assembly_row(benchmark::State& state) {
  const Case& c = kCases[state.range(0)];
  const bem::BodyGeometry body = sphere(3);
  const bem::RowAssembler assembler(body.nodes, body.extent, options_for(body, c).discretisation);
  bem::RowAssembler::Workspace work;
  bem::BlockRow<T> row;
  const int nodes = static_cast<int>(body.nodes.vertices.size());
  int vertex = 0;
  for (auto unused : state) {
    benchmark::DoNotOptimize(assembler.assemble(vertex, true, work, row));
    vertex = (vertex + 37) % nodes;  // prime to the number of nodes: all of them in turn
  }
  state.SetLabel(c.scheme);
  state.counters["body_s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) / nodes,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK_TEMPLATE(assembly_row, float)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(assembly_row, double)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);

/// The table of all radial functions and lags that a body needs.
void radial_table(benchmark::State& state) {
  const Case& c = kCases[state.range(0)];
  const bem::Scheme scheme = bem::Scheme::parse(c.scheme);
  const double kappa = bem::Material{"", 1, 1, 0.4, {}}.kappa();
  for (auto unused : state)
    benchmark::DoNotOptimize(
        bem::RadialTable(scheme, kappa, c.lam, bem::default_history_length(scheme, c.lam)));
  state.SetLabel(c.scheme);
}
BENCHMARK(radial_table)->DenseRange(0, 3)->Unit(benchmark::kMillisecond);

}  // namespace
