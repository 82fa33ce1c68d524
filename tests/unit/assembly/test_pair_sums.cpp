#include "assembly/pair_sums.hpp"

#include <random>
#include <utility>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

constexpr int kRows = 9 * 54 + 72;

template <class T>
PairSums<T> places(AlignedVector<T>& from, int padded_lanes) {
  const std::size_t part = 54 * static_cast<std::size_t>(padded_lanes);
  PairSums<T> sums;
  T* at = from.data();
  for (auto& y : sums.inertia) y = std::exchange(at, at + part);
  for (auto& y : sums.adjoint) y = std::exchange(at, at + part);
  sums.uniform = at;
  return sums;
}

template <class T>
double worst_difference(const LaneTable<T>& table, const LaneTable<double>& exact_table) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  double worst = 0;
  for (int size : {1, 7, 16, 32}) {
    PairScales scales{1.7, 0.2, 1.9, Vec3(1, -2, 0.5).normalized(), Vec3(0.3, 1, -1).normalized()};
    PairBatch batch;
    batch.size = size;
    for (int q = 0; q < size; ++q) {
      for (int i = 0; i < 3; ++i) batch.r[i][q] = 0.6 * any(random);
      for (int a = 0; a < 6; ++a) {
        batch.x_shape[a][q] = 0.1 * any(random);
        batch.y_shape[a][q] = any(random);
      }
    }
    batch.pad();
    PairScratch<T> scratch;
    AlignedVector<T> found(kRows * static_cast<std::size_t>(table.padded_lanes), T(0.25));
    AlignedVector<double> expected(kRows * static_cast<std::size_t>(exact_table.padded_lanes),
                                   0.25);
    accumulate_pair(table, scales, batch, scratch, places(found, table.padded_lanes));
    accumulate_pair_reference(exact_table, scales, batch,
                              places(expected, exact_table.padded_lanes));
    double scale = 0;
    for (double x : expected) scale = std::max(scale, std::abs(x - 0.25));
    for (int row = 0; row < kRows; ++row)
      for (int lane = 0; lane < table.lanes; ++lane)
        worst =
            std::max(worst, std::abs(static_cast<double>(found[row * table.padded_lanes + lane]) -
                                     expected[row * exact_table.padded_lanes + lane]) /
                                scale);
  }
  return worst;
}

}  // namespace

TEST_CASE("sums over pairs of points are those of the scalar kernels") {
  for (const char* name : {"bdf1", "bdf2", "radau2", "radau3"}) {
    const RadialTable table(Scheme::parse(name), 0.2, 3.0, 5, 1e-10, {}, hypersingular_family());
    INFO(name);
    CHECK(worst_difference(table.lanes(), table.lanes()) < 1e-13);
    CHECK(worst_difference(table.single_precision(), table.lanes()) < 2e-5);
  }
}
