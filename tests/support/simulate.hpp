#pragma once

#include "simulation/memory_source.hpp"
#include "simulation/simulation.hpp"
#include "support/models.hpp"

namespace bem_test {

/// A scene with one body "b" of archive "b".
inline bem::Scene one_body_scene(double time_step) {
  bem::Scene scene;
  scene.time_step = time_step;
  bem::BodySpec body;
  body.name = "b";
  body.archive.resolved = body.archive.written = "b";
  scene.bodies.push_back(body);
  return scene;
}

inline bem::Selection box_selection(const bem::Vec3& min, const bem::Vec3& max) {
  bem::Selection s;
  s.kind = bem::Selection::Kind::box;
  s.box_min = min;
  s.box_max = max;
  return s;
}

}  // namespace bem_test
