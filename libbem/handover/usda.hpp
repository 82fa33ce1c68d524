#pragma once

#include "handover/animated_scene.hpp"

namespace bem {

/// Writes a run as one file of Universal Scene Description in its text form, version 1.0
/// (https://openusd.org/release/api/_usd_geom__page_front.html): below the Xform "World" a Mesh for
/// every body, with points and extents by frame, faces as they are, texture coordinates as
/// primvars:st and fields as primvars; and a Mesh for every obstacle, with a transform by frame if
/// it moves. Time codes are times times frame_rate(). Numbers at vertices are in single precision.
/// Frames are read one after another for every attribute. Throws what the scene and the sink throw.
void write_usda(const AnimatedScene& scene, const ByteSink& sink);

}  // namespace bem
