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

TEST_CASE("the vectorised panel sums agree with the scalar reference on every instruction set") {
  const Vec3 normal = Vec3(1, -2, 3).normalized();
  for (const char* name : {"bdf1", "theta:0.75", "radau2"}) {
    const Scheme scheme = Scheme::parse(name);
    const RadialTable table(scheme, 0.2, 3.0, 5);
    const KernelScales scales(2.1, 1.3, 0.4);
    for (bool singular : {false, true})
      for (int size : {1, 6, 7, 33, 64}) {
        const PointBatch batch = random_batch(size, singular);
        AlignedVector reference(kPanelSums * table.padded_lanes(), 0.0);
        accumulate_panel_reference(table, scales, batch, normal, reference.data());
        double largest = 0;
        for (double v : reference) largest = std::max(largest, std::abs(v));
        for (int64_t target : hwy::SupportedAndGeneratedTargets()) {
          hwy::SetSupportedTargetsForTest(target);
          AlignedVector sums(reference.size(), 0.0);
          PanelScratch scratch;
          accumulate_panel(table, scales, batch, normal, scratch, sums.data());
          double worst = 0;
          for (std::size_t i = 0; i < sums.size(); ++i)
            worst = std::max(worst, std::abs(sums[i] - reference[i]));
          INFO(name << ", " << size << " points, target " << hwy::TargetName(target));
          CHECK(worst < 1e-14 * largest);
        }
        hwy::SetSupportedTargetsForTest(0);
      }
  }
}
