#pragma once

#include "handover/animated_scene.hpp"

namespace bem {

/// Writes a run as one binary glTF 2.0 file (.glb). A body is a mesh at its first frame, in a node
/// that moves with the body's frame, and has for every further frame a morph target with the
/// displacements and the changes of the normals since then; a body that keeps its shape has none.
/// An obstacle is a mesh in a node. One animation moves everything, linearly between the frames.
/// The node "World" turns the scene so that up is y. Normals have creases (ShadedSurface).
///
/// The file has about 24 bytes for every vertex and frame. Reads every frame twice. Throws
/// ErrorCode::resources if the file would be larger than 4 GB, and what the scene and the sink
/// throw.
void write_glb(const AnimatedScene& scene, const ByteSink& sink);

}  // namespace bem
