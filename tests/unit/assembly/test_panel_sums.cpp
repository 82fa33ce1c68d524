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

}  // namespace

namespace {

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
