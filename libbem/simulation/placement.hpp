#pragma once

#include "mesh/body_geometry.hpp"
#include "scene/scene.hpp"
#include "simulation/scene_loader.hpp"

#include <vector>

namespace bem {

/// Puts the bodies with a `place` where it says (docs/scene-format.md, "Places"): they have a
/// position and no `place` afterwards. `geometries`: by body. Throws ErrorCode::invalid_input,
/// naming the place in the scene, if a body would fall past its obstacle, and for obstacles that
/// cannot be read.
void place_bodies(Scene& scene, const std::vector<const BodyGeometry*>& geometries,
                  ModelSource& source);

}  // namespace bem
