#include "base/parallel.hpp"
#include "compress/dense_family.hpp"
#include "model/growth.hpp"
#include "simulation/simulation.hpp"
#include "support.hpp"

#include <chrono>
#include <cstring>
#include <map>
#include <numeric>

#include <benchmark/benchmark.h>

namespace {

using namespace bem_bench;

/// Sum of all words of a memory block, on all threads: what reading it takes at least. As the
/// products do, every thread reads a few streams side by side.
std::uint64_t plain_read(const float* data, std::size_t count) {
  constexpr std::size_t kTile = 1 << 18, kStreams = 4, kStream = kTile / kStreams;
  std::vector<std::uint64_t> sums(count / kTile);  // a last incomplete tile is left out
  bem::parallel_for(sums.size(), [&](std::size_t tile) {
    const float* from = data + tile * kTile;
    std::uint64_t sum[kStreams][4] = {};
    for (std::size_t i = 0; i < kStream; i += 8)
      for (std::size_t s = 0; s < kStreams; ++s) {
        std::uint64_t words[4];
        std::memcpy(words, from + s * kStream + i, sizeof words);
        for (int w = 0; w < 4; ++w) sum[s][w] += words[w];
      }
    for (const auto& stream : sum)
      for (std::uint64_t part : stream) sums[tile] += part;
  });
  return std::accumulate(sums.begin(), sums.end(), std::uint64_t(0));
}

/// One matrix with 128 million entries in single precision: larger than most caches.
const bem::DenseStore<float>& large_matrix() {
  constexpr std::size_t kSize = 11264;
  static const bem::DenseStore<float> matrix = [] {
    bem::DenseStore<float> m(kSize, kSize);
    bem::parallel_for(kSize, [&](std::size_t i) { std::fill_n(m.row(i), kSize, 1.0f); });
    return m;
  }();
  return matrix;
}

void set_bytes(benchmark::State& state, std::size_t bytes) {
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes) * state.iterations());
}

void read_matrix(benchmark::State& state) {
  const bem::DenseStore<float>& a = large_matrix();
  for (auto unused : state) benchmark::DoNotOptimize(plain_read(a.row(0), a.rows() * a.columns()));
  set_bytes(state, a.bytes());
}
BENCHMARK(read_matrix)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Product with 1, 2 or 4 vectors: the matrix is read once.
void matrix_product(benchmark::State& state) {
  const bem::DenseStore<float>& a = large_matrix();
  const int count = static_cast<int>(state.range(0));
  const std::vector<double> x(count * a.columns(), 1.0);
  std::vector<double> y(count * a.rows(), 0.0);
  for (auto unused : state) a.multiply_add(x.data(), y.data(), count);
  benchmark::DoNotOptimize(y.data());
  set_bytes(state, a.bytes());
}
BENCHMARK(matrix_product)
    ->Arg(1)
    ->Arg(2)
    ->Arg(4)
    ->Arg(24)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// A sphere of 642 nodes, computed once for each case.
class SphereSource : public bem::ModelSource {
 public:
  explicit SphereSource(const Case& c) {
    std::shared_ptr<const bem::BodyModel>& model = models()[c.scheme];
    if (!model) {
      bem::BodyGeometry body = sphere(3);
      const bem::PrecomputeOptions options = options_for(body, c);
      model = std::make_shared<const bem::BodyModel>(bem::precompute(std::move(body), options));
    }
    model_ = model;
  }
  std::shared_ptr<const bem::BodyModel> model(const bem::FilePath&) override { return model_; }
  bem::TractionData tractions(const bem::FilePath&, const std::vector<int>& nodes) override {
    return bem::extract_tractions(*model_, nodes);
  }
  const bem::BodyModel& model() const { return *model_; }

 private:
  bem::TriangleMesh obstacle_mesh(const bem::FilePath&) override { return {}; }

  static std::map<std::string, std::shared_ptr<const bem::BodyModel>>& models() {
    static std::map<std::string, std::shared_ptr<const bem::BodyModel>> all;
    return all;
  }
  std::shared_ptr<const bem::BodyModel> model_;
};

/// A free sphere that a short pressure has set in motion; no load acts while it is stepped.
bem::Scene ringing_sphere(double dt) {
  bem::BodySpec body;
  body.name = body.archive.resolved = "sphere";
  body.tractions.push_back({{}, 100.0, {{0, 1}, {2 * dt, 1}, {3 * dt, 0}}, false, {}});
  bem::Scene scene;
  scene.time_step = dt;
  scene.bodies.push_back(body);
  return scene;
}

double seconds_of_reading(const bem::BodyModel& model) {
  const auto read = [](const bem::MatrixFamily& family) {
    const auto& dense = dynamic_cast<const bem::DenseFamily<float>&>(family);
    for (int k = 0; k < dense.count(); ++k) {
      const bem::DenseStore<float>& m = dense.matrix(k);
      benchmark::DoNotOptimize(plain_read(m.row(0), m.rows() * m.columns()));
    }
  };
  const auto start = std::chrono::steady_clock::now();
  read(*model.h);
  for (const auto& inverse : model.inverse) read(*inverse);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A step without loads. `over_reading` is its time over that of a plain read of its matrices,
/// measured in turns with the steps.
void step(benchmark::State& state) {
  const Case& c = kCases[state.range(0)];
  SphereSource source(c);
  const double dt = source.model().discretisation.dt;
  bem::Simulation simulation(ringing_sphere(dt), source);
  const int warm_up = source.model().discretisation.history_length + 4;
  for (int i = 0; i < warm_up; ++i) simulation.step();
  double reading = 0, stepping = 0;
  for (auto unused : state) {
    reading += seconds_of_reading(source.model());
    const auto start = std::chrono::steady_clock::now();
    simulation.step();
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    state.SetIterationTime(seconds);
    stepping += seconds;
  }
  state.SetLabel(c.scheme);
  set_bytes(state, simulation.matrix_bytes());
  state.counters["over_reading"] = stepping / reading;
}
BENCHMARK(step)->DenseRange(0, 1)->Unit(benchmark::kMillisecond)->UseManualTime();

void growth(benchmark::State& state) {
  const Case& c = kCases[state.range(0)];
  const SphereSource source(c);
  int steps = 0;
  for (auto unused : state) steps = bem::growth_factor(source.model()).steps;
  state.SetLabel(c.scheme);
  state.counters["steps"] = steps;
}
BENCHMARK(growth)->DenseRange(0, 1)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
