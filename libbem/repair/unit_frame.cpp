#include "repair/unit_frame.hpp"

namespace bem {

TriangleMesh UnitFrame::to_unit(TriangleMesh mesh) const {
  for (Vec3& v : mesh.vertices) v = (v - centre) / size;
  return mesh;
}

TriangleMesh UnitFrame::from_unit(TriangleMesh mesh) const {
  for (Vec3& v : mesh.vertices) v = size * v + centre;
  return mesh;
}

UnitFrame unit_frame(const TriangleMesh& mesh) {
  std::vector<Vec3> used;
  for (const Triangle& t : mesh.triangles)
    for (int v : t) used.push_back(mesh.vertices[v]);
  const BoundingBox box = bounding_box(used);
  const double size = box.diagonal();
  return {box.centre(), size > 0 ? size : 1.0};
}

}  // namespace bem
