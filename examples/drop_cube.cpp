// Drops a rubber cube flat on a floor and prints what the floor feels: the contact force over time,
// and its impulse beside the change of the cube's momentum. Matrices are computed in memory; no
// file is read or written.
//
//   drop_cube            prints CSV: time [s], contact force [N], height of the centre [m]
#include "mesh/shapes.hpp"
#include "model/defaults.hpp"
#include "simulation/memory_source.hpp"
#include "simulation/simulation.hpp"

#include <cstdio>

int main() {
  const double size = 0.1, speed = 1, dt = 1e-3;  // [m], [m/s], [s]
  bem::Material rubber;
  rubber.density = 1000;       // [kg/m^3]
  rubber.shear_modulus = 1e5;  // [Pa]
  rubber.poisson_ratio = 0.3;

  // the body: a closed surface, its mass, and its matrices for this time step
  const bem::TriangleMesh mesh = bem::box(bem::Vec3(size, size, size), {2, 2, 2});
  const bem::DefaultBody cube_body = bem::default_body(mesh, rubber, dt);
  bem::MemorySource source;
  source.add("cube", bem::precompute(cube_body.geometry, cube_body.options));

  // the scene: what a scene file says
  bem::Scene scene;
  scene.time_step = dt;
  scene.gravity = bem::Vec3(0, 0, -9.81);
  scene.contact.enabled = true;
  bem::BodySpec cube;
  cube.name = "cube";
  cube.archive.resolved = "cube";
  cube.position = bem::Vec3(0, 0, size / 2 + 1e-3);
  cube.velocity = bem::Vec3(0, 0, -speed);
  scene.bodies.push_back(cube);
  bem::ObstacleSpec floor;
  floor.name = "floor";
  floor.shape = bem::PlaneObstacle{bem::Vec3::Zero(), bem::Vec3::UnitZ()};
  scene.obstacles.push_back(floor);

  bem::Simulation simulation(scene, source);
  const bem::Body& body = simulation.bodies()[0];
  const double momentum = body.linear_momentum().z();
  double impulse = 0;
  std::printf("t,force,height\n");
  for (int n = 0; n < 60; ++n) {
    simulation.step();
    double force = 0;  // on the body: it is side a of contacts with a plane
    for (const bem::Vec3& f : simulation.contact_forces()) force += f.z();
    impulse += dt * (force + scene.gravity.z() * body.frame().mass());
    std::printf("%.3f,%.6g,%.6g\n", simulation.time(), force, body.frame().translation().z());
  }
  std::fprintf(stderr, "impulse of floor and weight %.9g N s, change of momentum %.9g N s\n",
               impulse, body.linear_momentum().z() - momentum);
  return 0;
}
