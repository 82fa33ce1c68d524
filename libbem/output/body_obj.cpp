#include "output/body_obj.hpp"

#include "mesh/mesh_io.hpp"
#include "render/render_mesh.hpp"

namespace bem {

BodyObj::BodyObj(const TrajectoryBody& body, const std::string& folder)
    : triangles_(body.triangles), render_(body.render) {
  if (render_) libraries_ = render_->libraries_from(folder);
}

std::string BodyObj::text(const std::vector<Vec3>& positions,
                          const std::vector<Vec3>& normals) const {
  return render_ ? render_->obj.text(positions, normals, libraries_)
                 : obj_text({positions, triangles_});
}

}  // namespace bem
