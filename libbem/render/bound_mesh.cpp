#include "render/bound_mesh.hpp"

namespace bem {

BoundMesh::Shape BoundMesh::shape(std::vector<Vec3> surface) const {
  const SurfacePose pose = binding_.pose(std::move(surface));
  return {binding_.points(pose), binding_.normals(pose, mesh_->obj.normals())};
}

}  // namespace bem
