#include "convergence/convergence_study.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

/// u + a h^2 + b dt in every field, of two bodies of which the second has half of the errors.
StudyRun run_at(const StudyLevel& level) {
  StudyRun run;
  run.level = level;
  run.nodes = 100 * std::exp2(level.mesh);
  run.time_step = std::ldexp(0.01, -level.time);
  const double space = 0.02 * std::exp2(-level.mesh), time = 0.01 * std::exp2(-level.time);
  for (double part : {1.0, 0.5}) {
    BodyMotion motion;
    motion.position = {1 + part * space, 2 + part * time, -3};
    motion.rigid = motion.deformation = motion.position;
    motion.path = {0, 0.5, 0};
    run.motions.push_back(motion);
  }
  return run;
}

std::vector<StudyRun> runs_of(const LevelRange& meshes, const LevelRange& times) {
  std::vector<StudyRun> runs;
  for (const StudyLevel& level : study_levels(meshes, times)) runs.push_back(run_at(level));
  return runs;
}

}  // namespace

TEST_CASE("Errors in space and time are told apart", "[study]") {
  for (const LevelRange& range : {LevelRange{2, 1}, LevelRange{2, 0}, LevelRange{1, 1}}) {
    const StudyResult result = evaluate_study(runs_of(range, range), 1);
    REQUIRE(result.bodies.size() == 2);
    const QuantityResult& q = result.bodies[0].position;
    REQUIRE(q.mesh);
    REQUIRE(q.time);
    CHECK(q.mesh->scene_error == Approx(0.02).epsilon(0.01));
    CHECK(q.time->scene_error == Approx(0.01).epsilon(0.01));
    CHECK(q.error[0] == Approx(std::hypot(0.02, 0.01)).epsilon(0.01));
    CHECK(q.size == 0.5);
    if (range.coarser + range.finer > 2) {
      CHECK(*q.mesh->trend.order == Approx(2).margin(0.02));
      CHECK(*q.time->trend.order == Approx(1).margin(0.02));
    }
    CHECK(result.bodies[1].position.error[0] == Approx(0.5 * q.error[0]));
    CHECK(result.all.position.error[0] == Approx(q.error[0] * std::sqrt((1 + 0.25) / 2)));
  }
}

TEST_CASE("Differences are from the finest run of both", "[study]") {
  const std::vector<StudyRun> runs = runs_of({1, 1}, {1, 1});
  const QuantityResult q = evaluate_study(runs, 1).bodies[0].position;
  CHECK(q.from_finest.back() == 0);
  CHECK(q.from_finest[0] == Approx(std::hypot(0.01, 0.005)));
  CHECK(q.error.back() == Approx(std::hypot(0.01, 0.005)).epsilon(0.01));
}

TEST_CASE("Rigid bodies have time steps alone", "[study]") {
  const QuantityResult q = evaluate_study(runs_of({0, 0}, {1, 1}), 1).all.position;
  CHECK(!q.mesh);
  REQUIRE(q.time);
  CHECK(q.time->scene_error == Approx(0.01 * std::sqrt(0.625)).epsilon(0.01));
}

TEST_CASE("What differs by rounding alone has no trend, and what rounding moves has no size",
          "[study]") {
  std::vector<StudyRun> runs = runs_of({2, 1}, {2, 1});
  double noise = 1;
  for (StudyRun& run : runs)
    for (BodyMotion& motion : run.motions) {
      noise = -1.7 * noise + 0.3;
      if (std::abs(noise) > 1000) noise = 1;
      motion.position = {1 + 1e-16 * noise, 2, -3};
      motion.deformation = {1e-16 * noise, 0, 0};
    }
  const MotionResult all = evaluate_study(runs, 1).all;
  CHECK(all.position.size > 0);
  CHECK(all.deformation.size == 0);
  for (const QuantityResult* q : {&all.position, &all.deformation}) {
    CHECK(q->same());
    CHECK(q->converges());
    CHECK(!q->mesh->trend.order);
    CHECK(q->time->scene_error == 0);
    CHECK(q->error == std::vector<double>(runs.size(), 0));
    CHECK(q->from_finest == std::vector<double>(runs.size(), 0));
  }
  CHECK(!all.rigid.same());
}

TEST_CASE("Meshes that change nothing leave the trend of time steps", "[study]") {
  std::vector<StudyRun> runs = runs_of({1, 1}, {1, 1});
  for (StudyRun& run : runs)
    for (BodyMotion& motion : run.motions) motion.position[0] = 1;
  const QuantityResult q = evaluate_study(runs, 1).bodies[0].position;
  CHECK(q.mesh->same);
  CHECK(!q.same());
  CHECK(q.error[0] == Approx(0.01).epsilon(0.01));
}
