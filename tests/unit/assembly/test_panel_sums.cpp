#include "assembly/panel_sums.hpp"

#include <catch2/catch.hpp>
#include <hwy/highway.h>

using namespace bem;

namespace {

PointBatch random_batch(int size, bool singular) {
  PointBatch batch;
  batch.singular = singular;
  unsigned state = 12345;
  const auto uniform = [&state] {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) / double(1 << 24);
  };
  for (int q = 0; q < size; ++q) {
    const Vec3 r(uniform() - 0.5, uniform() - 0.5, uniform() + 0.1);
    const double shape[3] = {uniform(), uniform(), uniform()};
    batch.add(r, shape, 0.01 * uniform());
  }
  batch.pad();
  return batch;
}

/// accumulate_panel() in scalar double precision, one lane at a time.
void accumulate_panel_reference(const LaneTable<double>& table, const KernelScales& scales,
                                const PointBatch& batch, const Vec3& normal, double* sums) {
  constexpr int kPairs[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
  const int stride = table.padded_lanes;
  std::vector<double> values(static_cast<std::size_t>(kRadialCount) * stride);
  for (int q = 0; q < batch.size; ++q) {
    const Vec3 y(batch.r[0][q], batch.r[1][q], batch.r[2][q]);
    const double r = y.norm();
    const Vec3 h = y / r;
    const double hn = h.dot(normal);
    table.evaluate(r * scales.lam_per_distance, values.data());
    for (int lane = 0; lane < stride; ++lane) {
      const auto f = [&](int function) {
        const double rest = batch.singular ? table.static_part(function)[lane] : 0;
        return values[function * stride + lane] - rest;
      };
      const auto add = [&](int sum, double value) { sums[sum * stride + lane] += value; };
      double weight = 0;
      for (int a = 0; a < 3; ++a) {
        const double w = batch.shape_weight[a][q];
        weight += w;
        const double u = w * scales.displacement / r, p = w * scales.traction / (r * r);
        add(kSumA + a, u * f(kRadialA));
        for (int e = 0; e < 6; ++e) {
          const double hh = h[kPairs[e][0]] * h[kPairs[e][1]];
          add(kSumB + 6 * a + e, -u * hh * f(kRadialB));
          add(kSumS + 6 * a + e, p * hn * hh * f(kRadialS));
        }
        for (int e = 0; e < 3; ++e) {
          add(kSumP + 3 * a + e, p * h[e] * f(kRadialP));
          add(kSumQ + 3 * a + e, p * h[e] * f(kRadialQ));
        }
      }
      const double body = weight * scales.body_force;
      for (int e = 0; e < 3; ++e) add(kSumF + e, body * h[e] * f(kRadialF));
      for (int e = 0; e < 6; ++e)
        add(kSumFr + e, body * r * h[kPairs[e][0]] * h[kPairs[e][1]] * f(kRadialF));
      add(kSumM1, -body * hn * f(kRadialM1));
      add(kSumM0, body * r * f(kRadialM0));
      add(kSumC0, body * r * f(kRadialC0));
    }
  }
}

/// Worst difference to the reference over all sums and lanes, relative to the largest sum.
template <class T>
double worst_difference(const LaneTable<T>& table, const LaneTable<double>& exact_table,
                        const PointBatch& batch) {
  const Vec3 normal = Vec3(1, -2, 3).normalized();
  const KernelScales scales(2.1, 1.3, 0.4);
  AlignedVector<double> exact(static_cast<std::size_t>(kPanelSums) * exact_table.padded_lanes, 0.0);
  accumulate_panel_reference(exact_table, scales, batch, normal, exact.data());
  AlignedVector<T> sums(static_cast<std::size_t>(kPanelSums) * table.padded_lanes, T(0));
  PanelScratch<T> scratch;
  accumulate_panel(table, scales, batch, normal, scratch, sums.data());
  double worst = 0, largest = 0;
  for (int s = 0; s < kPanelSums; ++s)
    for (int lane = 0; lane < table.lanes; ++lane) {
      const double value = exact[s * exact_table.padded_lanes + lane];
      worst = std::max(worst, std::abs(sums[s * table.padded_lanes + lane] - value));
      largest = std::max(largest, std::abs(value));
    }
  return worst / largest;
}

}  // namespace

TEST_CASE("the vectorised panel sums agree with the scalar reference on every instruction set") {
  for (const char* name : {"bdf1", "theta:0.75", "radau2", "radau3"}) {
    const RadialTable table(Scheme::parse(name), 0.2, 3.0, 5);
    const LaneTable<float> single = table.single_precision();
    for (bool singular : {false, true})
      for (int size : {1, 6, 7, 33, 64}) {
        const PointBatch batch = random_batch(size, singular);
        for (int64_t target : hwy::SupportedAndGeneratedTargets()) {
          hwy::SetSupportedTargetsForTest(target);
          INFO(name << ", " << size << " points, target " << hwy::TargetName(target));
          CHECK(worst_difference(table.lanes(), table.lanes(), batch) < 1e-14);
          if (!singular) CHECK(worst_difference(single, table.lanes(), batch) < 1e-6);
        }
        hwy::SetSupportedTargetsForTest(0);
      }
  }
}
