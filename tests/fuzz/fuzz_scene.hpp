#pragma once

#include "archive/archive_reader.hpp"
#include "model/nodal_tractions.hpp"
#include "support/simulate.hpp"

// What the targets for archives and checkpoints, and the program that makes their seeds, share.

namespace bem_fuzz {

/// The few nodes of an octahedron: archives of some kilobytes.
inline bem::BodyGeometry small_body() {
  const double r = 0.1;
  const bem::TriangleMesh mesh{
      {{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  return bem_test::geometry_of(mesh, 1000);
}

/// A model of it with a short history.
inline bem::BodyModel small_model(const std::string& scheme, const std::string& codec,
                                  bem::InverseKind inverse = bem::InverseKind::dense,
                                  bem::ModelKind kind = bem::ModelKind::dynamic) {
  const bem::BodyGeometry geometry = small_body();
  const bem::Material rubber = bem_test::material(1000, 1e5, 0.3);
  bem::PrecomputeOptions options = kind == bem::ModelKind::quasistatic
                                       ? bem_test::quasistatic_options(geometry, rubber)
                                       : bem_test::options_for(geometry, rubber, scheme, 1);
  options.kind = kind;
  if (kind == bem::ModelKind::dynamic) options.discretisation.dt = 0.01;
  if (kind == bem::ModelKind::dynamic) options.discretisation.history_length = 2;
  options.codec = bem::CodecOptions(bem::codec_named(codec));
  options.inverse = inverse;
  options.window = 0.99;
  return bem::precompute(geometry, options);
}

/// One that is held at a vertex and falls on a plane; loads, joints and contacts act on it.
inline bem::Scene small_scene(bem::Loads loads = bem::Loads::all) {
  bem::Scene scene = bem_test::one_body_scene(0.01);
  scene.gravity = bem::Vec3(0, 0, -9.81);
  if (loads != bem::Loads::all) return scene;
  scene.bodies[0].fixed.push_back(
      bem_test::box_selection(bem::Vec3(0.05, -1, -1), bem::Vec3(1, 1, 1)));
  bem::ObstacleSpec floor;
  floor.name = "floor";
  floor.shape = bem::PlaneObstacle{bem::Vec3(0, 0, -0.0999), bem::Vec3(0, 0, 1)};
  scene.obstacles.push_back(floor);
  scene.contact.enabled = true;
  return scene;
}

/// The same with a load besides, in whose history other scenes have to put something else.
inline bem::Scene loaded_scene() {
  bem::Scene scene = small_scene();
  bem::TractionSpec pull;
  pull.select = bem_test::box_selection(bem::Vec3(-1, -1, -1), bem::Vec3(1, 1, 1));
  pull.load = bem::Vec3(100, 0, 0);
  scene.bodies[0].tractions.push_back(pull);
  return scene;
}

}  // namespace bem_fuzz
