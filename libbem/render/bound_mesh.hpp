#pragma once

#include "render/render_mesh.hpp"
#include "render/surface_binding.hpp"

#include <memory>

namespace bem {

/// A render mesh that goes with a simulated surface.
class BoundMesh {
 public:
  /// `surface`: at rest, in the coordinates of the mesh.
  BoundMesh(std::shared_ptr<const RenderMesh> mesh, const TriangleMesh& surface)
      : mesh_(std::move(mesh)), binding_(surface, mesh_->triangles) {}

  const std::shared_ptr<const RenderMesh>& mesh() const { return mesh_; }
  const SurfaceBinding& binding() const { return binding_; }

  struct Shape {
    std::vector<Vec3> positions;  ///< of the vertices of the mesh [m]
    std::vector<Vec3> normals;    ///< unit vectors for the normals of its ObjTemplate
  };
  /// Where the mesh is when the vertices of the surface are somewhere.
  Shape shape(std::vector<Vec3> surface) const;

 private:
  std::shared_ptr<const RenderMesh> mesh_;
  SurfaceBinding binding_;
};

}  // namespace bem
