#pragma once

#include "mesh/body_geometry.hpp"
#include "scene/scene.hpp"

namespace bem {

/// Nodes that a selection picks, ascending. Triangles stand for their corners; a box, a sphere and
/// the side of a plane pick the vertices in them, with a normal those that belong to a triangle
/// with all corners in them and facing that way. Throws ErrorCode::invalid_input, naming the place
/// in the scene, if an index is out of range or nothing is picked.
std::vector<int> select_nodes(const BodyGeometry& geometry, const Selection& selection);

/// Triangles (of geometry.nodes) that a selection picks, ascending: those with all corners chosen,
/// and facing the normal if there is one. Errors as above.
std::vector<int> select_triangles(const BodyGeometry& geometry, const Selection& selection);

/// Calls `visit` with every selection of a body; `Body` is BodySpec or const BodySpec.
template <class Body, class Visit>
void for_each_selection(Body& body, const Visit& visit) {
  for (auto& fixed : body.fixed) visit(fixed);
  for (auto& handle : body.handles) visit(handle.select);
  for (auto& traction : body.tractions) visit(traction.select);
}

/// The first selection of a body by numbers of vertices or triangles, which are those of its mesh
/// file and mean others, or none, of a mesh that is made of it; null if there is none.
const Selection* selection_by_numbers(const BodySpec& body);

/// The selection in a text that is another one for every other selection.
std::string to_text(const Selection& selection);

}  // namespace bem
