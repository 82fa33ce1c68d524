#pragma once

#include "scene/scene.hpp"

#include <vector>

namespace bem {

/// How a run of a convergence study differs from the scene: by 2^mesh times the nodes, which is
/// edges of 2^(-mesh/2) times the length, and by time steps of 2^-time times the length.
struct StudyLevel {
  int mesh = 0, time = 0;
};

/// Levels on both sides of the scene's own.
struct LevelRange {
  int coarser = 2, finer = 1;  ///< >= 0
};

/// The runs of a study, cheap ones first but for that of the scene, which is number 0: meshes with
/// the scene's time step, time steps with the scene's meshes, and the finest of both together.
std::vector<StudyLevel> study_levels(const LevelRange& meshes, const LevelRange& times);

/// The range for bodies of which the smallest has `least` nodes, and all together `total`: no mesh
/// has less than 12 nodes. What cannot be coarser is finer, as long as that is cheap: up to 1000
/// nodes in all.
LevelRange possible_meshes(LevelRange range, std::size_t least, std::size_t total);

/// The range for a run of so many steps: the coarsest has at least four.
LevelRange possible_times(LevelRange range, long steps);

/// When the runs of a study are compared: at steps of the scene's own run.
struct StudyTimes {
  long interval = 1;  ///< steps from one time to the next
  long count = 0;     ///< without the start

  long steps() const { return interval * count; }
};

/// Times at frames of the scene, one of which is written every `every` steps, where all runs have a
/// step; at most a hundred.
StudyTimes study_times(long steps, long every, const LevelRange& times);

/// Number of nodes of a body on a level, whose mesh has this number in the scene.
int nodes_at(const StudyLevel& level, std::size_t nodes);

/// The scene on another level: its time step, and the settings of its bodies. `nodes`: by body, in
/// the scene's own run. Rigid bodies keep their meshes.
Scene scene_at(const Scene& scene, const StudyLevel& level, const std::vector<std::size_t>& nodes);

}  // namespace bem
