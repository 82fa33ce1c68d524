#pragma once

#include "simulation/simulation.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bem {

/// A scene with contact whose friction problems are of interest.
struct OwnScene {
  std::string name;
  int steps = 0;
  std::unique_ptr<Simulation> simulation;
};

struct NamedProblem {
  std::string name;
  FrictionProblem problem;
};

/// Runs the scene and returns some of its contact problems with at least ten contacts: about
/// `count` in equal distances and the one that took the most Newton steps, marked by a star.
std::vector<NamedProblem> record_problems(OwnScene& scene, int count);

/// Number of scenes; they are made one at a time because each holds the matrices of its bodies.
int own_scene_count();
/// Computes the matrices of the scene's bodies, some seconds.
OwnScene make_own_scene(int index);

}  // namespace bem
