#include "convergence/study_levels.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

constexpr std::size_t kLeastNodes = 12, kFewNodes = 1000;
constexpr long kLeastSteps = 4, kMostTimes = 100;

void set_time_level(PrecomputeSettings& settings, int time) {
  if (settings.history)
    settings.history =
        std::max(1, static_cast<int>(std::lround(std::ldexp(*settings.history, time))));
  if (settings.window != 0) settings.window = std::pow(settings.window, std::ldexp(1.0, -time));
}

}  // namespace

std::vector<StudyLevel> study_levels(const LevelRange& meshes, const LevelRange& times) {
  std::vector<StudyLevel> levels = {{0, 0}};
  for (int m = -meshes.coarser; m <= meshes.finer; ++m)
    if (m != 0) levels.push_back({m, 0});
  for (int t = -times.coarser; t <= times.finer; ++t)
    if (t != 0) levels.push_back({0, t});
  if (meshes.finer > 0 && times.finer > 0) levels.push_back({meshes.finer, times.finer});
  return levels;
}

LevelRange possible_meshes(LevelRange range, std::size_t least, std::size_t total) {
  while (range.coarser > 0 && (least >> range.coarser) < kLeastNodes) {
    --range.coarser;
    if (total << (range.finer + 1) <= kFewNodes) ++range.finer;
  }
  return range;
}

LevelRange possible_times(LevelRange range, long steps) {
  while (range.coarser > 0 && (steps >> range.coarser) < kLeastSteps) --range.coarser;
  return range;
}

StudyTimes study_times(long steps, long every, const LevelRange& times) {
  const long coarsest = 1L << times.coarser;
  const auto multiple_above = [&](long least) {
    return (std::max(least, 1L) + coarsest - 1) / coarsest * coarsest;
  };
  StudyTimes out;
  out.interval = multiple_above(std::max(every, (steps + kMostTimes - 1) / kMostTimes));
  if (out.interval > steps) out.interval = multiple_above(1);
  out.count = steps / out.interval;
  return out;
}

int nodes_at(const StudyLevel& level, std::size_t nodes) {
  return static_cast<int>(std::lround(std::ldexp(static_cast<double>(nodes), level.mesh)));
}

Scene scene_at(const Scene& scene, const StudyLevel& level, const std::vector<std::size_t>& nodes) {
  Scene out = scene;
  out.time_step = std::ldexp(scene.time_step, -level.time);
  for (std::size_t b = 0; b < out.bodies.size(); ++b) {
    PrecomputeSettings& settings = out.bodies[b].source->settings;
    set_time_level(settings, level.time);
    if (level.mesh != 0 && settings.model != ModelKind::rigid)
      settings.nodes = nodes_at(level, nodes[b]);
  }
  return out;
}

}  // namespace bem
