// Holds a beam at one end, presses its tip down with a pressure that stops suddenly, and prints the
// tip's path and the period of the vibration that is left, beside that of a slender beam.
//
//   pluck_beam           prints CSV: time [s], deflection of the tip [m]
#include "dynamics/body_output.hpp"
#include "mesh/shapes.hpp"
#include "model/defaults.hpp"
#include "simulation/memory_source.hpp"
#include "simulation/simulation.hpp"

#include <cmath>
#include <cstdio>

int main() {
  const double length = 0.5, thickness = 0.05, dt = 5e-3;  // [m], [m], [s]
  bem::Material rubber;
  rubber.density = 1000;       // [kg/m^3]
  rubber.shear_modulus = 1e5;  // [Pa]
  rubber.poisson_ratio = 0.3;

  const bem::TriangleMesh mesh = bem::box(bem::Vec3(length, thickness, thickness), {12, 2, 2});
  const bem::DefaultBody beam_body = bem::default_body(mesh, rubber, dt);
  bem::MemorySource source;
  source.add("beam", bem::precompute(beam_body.geometry, beam_body.options));

  // selections are in the coordinates of the mesh, whose origin is its centre
  const auto end = [&](double sign) {
    bem::Selection s;
    s.kind = bem::Selection::Kind::box;
    s.box_min = bem::Vec3(sign * length / 2 - 1e-6, -1, -1);
    s.box_max = bem::Vec3(sign * length / 2 + 1e-6, 1, 1);
    return s;
  };
  bem::BodySpec beam;
  beam.name = "beam";
  beam.archive.resolved = "beam";
  beam.fixed.push_back(end(-1));
  bem::TractionSpec push;
  push.select = end(1);
  push.load = bem::Vec3(0, 0, -20);  // [Pa]
  push.profile = {{0, 0}, {0.2, 1}, {0.2001, 0}};
  beam.tractions.push_back(push);
  bem::Scene scene;
  scene.time_step = dt;
  scene.bodies.push_back(beam);

  int tip = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (mesh.vertices[i].x() > mesh.vertices[tip].x() + 1e-9) tip = static_cast<int>(i);

  bem::Simulation simulation(scene, source);
  double before = 0, first = 0, last = 0;  // crossings of zero, upwards
  int crossings = 0;
  std::printf("t,deflection\n");
  while (simulation.time() < 5) {
    simulation.step();
    const double t = simulation.time();
    const double now =
        bem::BodyOutput(simulation.bodies()[0]).positions()[tip].z() - mesh.vertices[tip].z();
    std::printf("%.3f,%.6g\n", t, now);
    if (t > 0.3 && before < 0 && now >= 0) {
      last = t - dt * now / (now - before);
      if (crossings++ == 0) first = last;
    }
    before = now;
  }
  const double young = 2 * rubber.shear_modulus * (1 + rubber.poisson_ratio);
  const double root = 1.8751 / length;  // of cos(x) cosh(x) = -1
  const double slender =
      2 * bem::kPi / (root * root * thickness * std::sqrt(young / 12 / rubber.density));
  std::fprintf(stderr, "period %.4f s, of a slender beam %.4f s\n",
               (last - first) / (crossings - 1), slender);
  return 0;
}
