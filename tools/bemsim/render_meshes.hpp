#pragma once

#include "plan.hpp"

namespace bem {

/// Reads the render meshes that are written and binds them to their bodies; bodies with the same
/// archive share one. Warns of those that are far from the simulated surface. Throws
/// ErrorCode::invalid_input, naming the place in the scene.
void plan_render_meshes(Plan& plan);

/// "render mesh uv.obj: 5000 vertices, up to 0.001 m from the simulated surface (0.1 % of the
/// size)".
std::string render_mesh_text(const PlannedBody& body);

}  // namespace bem
