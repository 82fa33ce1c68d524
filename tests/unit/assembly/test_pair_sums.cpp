#include "assembly/pair_sums.hpp"
#include "support/galerkin_kernels.hpp"

#include <random>
#include <utility>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

constexpr int kRows = 9 * 54 + 72;

template <class T>
PairSums<T> places(AlignedVector<T>& from, int padded_lanes) {
  PairSums<T> sums;
  sums.lanes = padded_lanes;
  T* at = from.data();
  for (auto& y : sums.inertia)
    for (auto& x : y) x = std::exchange(at, at + 9 * padded_lanes);
  for (auto& y : sums.adjoint)
    for (auto& x : y) x = std::exchange(at, at + 9 * padded_lanes);
  for (auto& x : sums.uniform) x = std::exchange(at, at + 12 * padded_lanes);
  return sums;
}

/// accumulate_pair() in scalar double precision, one lane at a time, from the tensors.
void accumulate_pair_reference(const LaneTable<double>& table, const PairScales& scales,
                               const Vec3& m, const Vec3& n, const PairBatch& batch,
                               const PairSums<double>& sums) {
  const std::size_t stride = table.padded_lanes;
  std::vector<double> values(kHypersingularCount * stride);
  int fibre = 0;
  for (int q = 0; q < batch.size; ++q) {
    if (q == batch.begin[fibre + 1]) ++fibre;
    const auto shape = [&](bool of_x, int row) {
      return of_x == batch.x_stays ? batch.staying[row][fibre] : batch.moving[row][q];
    };
    const Vec3 r(batch.r[0][q], batch.r[1][q], batch.r[2][q]);
    const SurfacePair g = surface_pair(Vec3::Zero(), m, r, n);
    table.evaluate(g.r * scales.lam_per_distance, values.data());
    for (int lane = 0; lane < table.lanes; ++lane) {
      HypersingularValues<double> f;
      for (int k = 0; k < kHypersingularCount; ++k) f[k] = values[k * stride + lane];
      const Mat3 inertia = inertia_kernel(g, f, scales.density),
                 adjoint = dynamic_adjoint_kernel(g, f);
      const Vec3 pressure = pressure_kernel(g, f, scales.kappa);
      for (int x = 0; x < 6; ++x) {
        const double weight = shape(true, x + 1);
        for (int e = 0; e < 9; ++e) {
          const std::size_t at = e * stride + lane;
          for (int y = 0; y < 6; ++y)
            sums.inertia[y][x][at] += weight * shape(false, y + 1) * inertia(e / 3, e % 3);
          for (int y = 0; y < 3; ++y)
            sums.adjoint[y][x][at] += weight * shape(false, y + 1) * adjoint(e / 3, e % 3);
          sums.uniform[x][at] += weight * shape(false, 0) * adjoint(e / 3, e % 3);
        }
        for (int e = 0; e < 3; ++e)
          sums.uniform[x][(9 + e) * stride + lane] += weight * shape(false, 0) * pressure[e];
      }
    }
  }
}

template <class T>
double worst_difference(const LaneTable<T>& table, const LaneTable<double>& exact_table) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  double worst = 0;
  for (const auto& [x_stays, sizes] : std::vector<std::pair<bool, std::vector<int>>>{
           {true, {1}}, {false, {1, 4, 2}}, {true, {16, 16, 3, 16, 13}}, {false, {3, 3, 3}}}) {
    const PairScales scales{1.7, 0.2, 1.9};
    const Vec3 m = Vec3(1, -2, 0.5).normalized(), n = Vec3(0.3, 1, -1).normalized();
    PairBatch batch;
    batch.x_stays = x_stays;
    for (int size : sizes) {
      for (auto& row : batch.staying) row[batch.fibres] = any(random);
      batch.staying[0][batch.fibres++] = 1;
      batch.size += size;
      batch.begin[batch.fibres] = batch.size;
    }
    for (int q = 0; q < batch.size; ++q) {
      for (auto& component : batch.r) component[q] = 0.6 * any(random);
      for (auto& row : batch.moving) row[q] = 0.1 * any(random);
    }
    batch.pad();
    PairScratch<T> scratch;
    AlignedVector<T> found(kRows * static_cast<std::size_t>(table.padded_lanes), T(0.25));
    AlignedVector<double> expected(kRows * static_cast<std::size_t>(exact_table.padded_lanes),
                                   0.25);
    accumulate_pair(table, scales, m, n, batch, scratch, places(found, table.padded_lanes));
    accumulate_pair_reference(exact_table, scales, m, n, batch,
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

TEST_CASE("points are collected in fibres of which one end stays") {
  const double a[3] = {0.2, 0.3, 0.5}, b[3] = {0.1, 0.1, 0.8}, c[3] = {0.6, 0.3, 0.1};
  PairBatch batch;
  std::vector<std::pair<bool, std::vector<int>>> found;  // by batch: does x stay, ends of fibres
  double weight = 0;
  const auto consume = [&](const PairBatch& given) {
    found.emplace_back(given.x_stays,
                       std::vector<int>(given.begin + 1, given.begin + 1 + given.fibres));
    for (int f = 0; f < given.fibres; ++f)
      for (int q = given.begin[f]; q < given.begin[f + 1]; ++q)
        weight += given.moving[0][q] * given.staying[0][f];
  };
  FibreCollector fibres(batch, consume);
  const Vec3 r(1, 2, 3);
  fibres.add(r, a, b, 1);  // a stays as x
  fibres.add(r, a, c, 2);
  fibres.add(r, b, c, 3);  // c stays as y
  fibres.add(r, a, c, 4);
  fibres.add(r, c, a, 5);                               // alone
  for (int i = 0; i < 20; ++i) fibres.add(r, b, c, 6);  // longer than a fibre may be
  fibres.finish();
  CHECK(weight == Approx(1 + 2 + 3 + 4 + 5 + 20 * 6));
  const std::vector<std::pair<bool, std::vector<int>>> expected = {
      {true, {2}}, {false, {2}}, {true, {1, 17, 21}}};
  CHECK(found == expected);
}
