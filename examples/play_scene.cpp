// Runs a scene file with the archives that it names, as bemsim does, without writing anything: the
// shortest way from a file to bodies in motion.
//
//   play_scene SCENE.json          prints for every body where its centre of mass is at the end
#include "base/error.hpp"
#include "scene/scene_json.hpp"
#include "simulation/archive_source.hpp"
#include "simulation/simulation.hpp"

#include <cstdio>

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: play_scene SCENE.json\n");
    return 2;
  }
  const bem::Scene scene = bem::read_scene(argv[1]);
  bem::ArchiveSource source;
  bem::Simulation simulation(scene, source);
  const long steps = bem::step_count(scene.duration, scene.time_step);
  for (long n = 0; n < steps; ++n) simulation.step();
  for (const bem::Body& body : simulation.bodies()) {
    const bem::Vec3 x = body.frame().translation();
    std::printf("%s: %.6g %.6g %.6g m after %g s\n", body.name().c_str(), x[0], x[1], x[2],
                simulation.time());
  }
  return 0;
} catch (const bem::Error& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return static_cast<int>(e.code());
}
