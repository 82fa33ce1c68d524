#include "model/defaults.hpp"

#include "mesh/solids.hpp"

namespace bem {

SpatialMethod default_method(const Surface& surface) {
  return surface.components.size() == 1 ? SpatialMethod::galerkin : SpatialMethod::collocation;
}

std::optional<double> default_corner_angle(SpatialMethod method) {
  constexpr double kGalerkin = 40;
  return method == SpatialMethod::galerkin ? std::optional(kGalerkin) : std::nullopt;
}

InverseKind default_inverse(const BodyGeometry& geometry, ModelKind kind) {
  constexpr std::size_t kMostDense = 8000;  // nodes
  const bool large = geometry.nodes.vertices.size() > kMostDense && kind == ModelKind::dynamic;
  return large ? InverseKind::iterative : InverseKind::dense;
}

DefaultBody default_body(TriangleMesh mesh, const Material& material, double dt) {
  const std::string name = "the mesh";
  const Surface surface = make_surface(std::move(mesh), name);
  check_single_solid(surface, name);
  DefaultBody out;
  Discretisation& d = out.options.discretisation;
  d.material = material;
  d.method = default_method(surface);
  d.dt = dt;
  out.geometry = make_geometry(surface, material.density);
  out.geometry.corner_angle_deg = default_corner_angle(d.method);
  d.history_length = default_history_length(d.scheme, traversal_steps(out.geometry, material, dt));
  out.options.codec = CodecOptions(codec_named("lowrank"));
  out.options.inverse = default_inverse(out.geometry, out.options.kind);
  out.options.measure_growth = !d.is_galerkin();
  return out;
}

}  // namespace bem
