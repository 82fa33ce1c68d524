#include "convergence/study_levels.hpp"

#include <catch2/catch.hpp>

using namespace bem;

namespace {

std::vector<std::pair<int, int>> pairs(const std::vector<StudyLevel>& levels) {
  std::vector<std::pair<int, int>> out;
  for (const StudyLevel& level : levels) out.emplace_back(level.mesh, level.time);
  return out;
}

}  // namespace

TEST_CASE("The scene comes first, the finest run last", "[levels]") {
  using Pairs = std::vector<std::pair<int, int>>;
  CHECK(pairs(study_levels({1, 1}, {2, 1})) ==
        Pairs{{0, 0}, {-1, 0}, {1, 0}, {0, -2}, {0, -1}, {0, 1}, {1, 1}});
  CHECK(pairs(study_levels({1, 0}, {1, 0})) == Pairs{{0, 0}, {-1, 0}, {0, -1}});
  CHECK(pairs(study_levels({0, 0}, {0, 1})) == Pairs{{0, 0}, {0, 1}});
}

TEST_CASE("Meshes have twelve nodes at least", "[levels]") {
  const auto range = [](std::size_t nodes) {
    const LevelRange r = possible_meshes({2, 1}, nodes, nodes);
    return std::pair(r.coarser, r.finer);
  };
  CHECK(range(1000) == std::pair(2, 1));
  CHECK(range(48) == std::pair(2, 1));
  CHECK(range(42) == std::pair(1, 2));
  CHECK(range(8) == std::pair(0, 3));
  CHECK(possible_meshes({2, 1}, 8, 2000).finer == 1);
}

TEST_CASE("All runs have steps at the times that are compared", "[levels]") {
  for (long steps : {1L, 3L, 7L, 16L, 120L, 1000L, 12345L})
    for (long every : {1L, 3L, 500L}) {
      const LevelRange range = possible_times({2, 1}, steps);
      const StudyTimes times = study_times(steps, every, range);
      CHECK(times.count >= 1);
      CHECK(times.count <= 100);
      CHECK(times.steps() <= steps);
      CHECK(times.interval % (1L << range.coarser) == 0);
    }
  CHECK(possible_times({2, 1}, 16).coarser == 2);
  CHECK(possible_times({2, 1}, 15).coarser == 1);
  CHECK(possible_times({2, 1}, 7).coarser == 0);
  CHECK(study_times(120, 1, {2, 1}).interval == 4);
  CHECK(study_times(120, 1, {2, 1}).count == 30);
  CHECK(study_times(1000, 1, {0, 1}).interval == 10);
}

TEST_CASE("A scene on a level has other nodes and time steps, and the rest as it was", "[levels]") {
  Scene scene;
  scene.time_step = 0.01;
  scene.bodies.resize(2);
  for (BodySpec& body : scene.bodies) body.source.emplace();
  scene.bodies[0].source->settings.history = 10;
  scene.bodies[0].source->settings.window = 0.81;
  scene.bodies[1].source->settings.model = ModelKind::rigid;
  const Scene fine = scene_at(scene, {1, 1}, {100, 0});
  CHECK(fine.time_step == 0.005);
  CHECK(fine.bodies[0].source->settings.nodes == 200);
  CHECK(fine.bodies[0].source->settings.history == 20);
  CHECK(fine.bodies[0].source->settings.window == Approx(0.9));
  CHECK(!fine.bodies[1].source->settings.nodes);
  CHECK(!scene_at(scene, {0, -1}, {100, 0}).bodies[0].source->settings.nodes);
}
