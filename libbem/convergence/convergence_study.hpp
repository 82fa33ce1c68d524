#pragma once

#include "convergence/motion_record.hpp"
#include "convergence/study_levels.hpp"
#include "convergence/trend.hpp"

#include <functional>
#include <string>
#include <vector>

namespace bem {

/// One run of a study.
struct StudyRun {
  StudyLevel level;
  double nodes = 0;                   ///< of all deformable bodies
  double time_step = 0;               ///< [s]
  std::vector<BodyMotion> motions;    ///< by body
  std::optional<double> first_touch;  ///< end of the first step with contacts [s]
  long steps = 0, unmet_steps = 0;    ///< those whose constraints were not met
};

/// Simulates a scene that scene_at() has made and whose archives are prepared, and records where
/// the points are at the start and at the study's times. `done`: called after each step with the
/// part that is done; it may throw. Throws what Simulation throws.
StudyRun simulate_level(const Scene& scene, ModelSource& source, const StudyLevel& level,
                        const StudyTimes& times,
                        const std::vector<std::shared_ptr<const FollowedPoints>>& points,
                        const std::function<void(double)>& done);

/// What one series of runs says of a quantity.
struct SeriesResult {
  Trend trend;
  std::vector<std::size_t> runs;  ///< coarse ones first
  double scene_error = 0;         ///< of the scene's own run
  bool same = false;              ///< all runs agree to rounding: there is no trend, and no error
};

/// A quantity in all runs. Differences and errors are root mean squares over surface and time [m].
struct QuantityResult {
  double size = 0;  ///< of the quantity itself, in the finest run; 0: it is rounding in all runs
  std::optional<SeriesResult> mesh, time;  ///< without levels on one side: none
  std::vector<double> from_finest;         ///< by run: difference from the finest run
  /// By run: difference from the limit of meshes and time steps together, which adds what is left
  /// of both to the finest run.
  std::vector<double> error;
  bool converges() const {
    return (!mesh || mesh->trend.converges) && (!time || time->trend.converges);
  }
  bool same() const { return (!mesh || mesh->same) && (!time || time->same); }
};

/// Of a body, or with the mean over bodies of all.
struct MotionResult {
  QuantityResult position, rigid, deformation;
};

struct StudyResult {
  MotionResult all;
  std::vector<MotionResult> bodies;
};

/// The order of errors in space, in the length of edges, where the motion is smooth.
inline constexpr double kExpectedMeshOrder = 2;

/// The order in time that errors of the scene's bodies have at best where loads set in suddenly: 1
/// where a scheme has no more, else 2.
double expected_time_order(const Scene& scene);

/// Compares the runs of study_levels(), in its order. Sizes and differences below a part of 1e-12
/// of the distances of the points from the origin are rounding, and come out as 0.
StudyResult evaluate_study(const std::vector<StudyRun>& runs, double expected_time_order);

}  // namespace bem
