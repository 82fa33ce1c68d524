#pragma once

#include "mesh/surface.hpp"
#include "model/precompute.hpp"

#include <optional>

namespace bem {

// What bemprecomp does where no option says otherwise.

/// Galerkin, or collocation for a body with a cavity: around a cavity the equations of the Galerkin
/// method hold for any rigid motion of its surface.
SpatialMethod default_method(const Surface& surface);
/// See BodyGeometry::corner_angle_deg; the tractions of the Galerkin method are wrong by much where
/// those of a held face reach over its edge, and collocation remains the paper's.
std::optional<double> default_corner_angle(SpatialMethod method);
/// Dense up to 8000 nodes and for models that need the inverse.
InverseKind default_inverse(const BodyGeometry& geometry, ModelKind kind);

/// A body and the options that its matrices are computed with.
struct DefaultBody {
  BodyGeometry geometry;
  PrecomputeOptions options;
};
/// From a closed mesh of one solid, with the defaults: radau2, codec "lowrank", a history that is
/// as long as waves need. `dt` [s] > 0. Throws ErrorCode::invalid_input as make_surface() and
/// check_single_solid().
DefaultBody default_body(TriangleMesh mesh, const Material& material, double dt);

}  // namespace bem
