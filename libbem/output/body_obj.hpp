#pragma once

#include "output/trajectory_contents.hpp"

#include <string>
#include <vector>

namespace bem {

/// OBJ texts of a body: vertices and faces of its mesh in their order, with coordinates as the
/// shortest decimals that read back to the same double. For a render mesh it is the text of the
/// file that the mesh comes from, with other coordinates.
class BodyObj {
 public:
  /// `folder`: where the texts will be files, for the paths of material libraries.
  BodyObj(const TrajectoryBody& body, const std::string& folder);

  /// `normals`: those of BodyFrame.
  std::string text(const std::vector<Vec3>& positions, const std::vector<Vec3>& normals) const;

 private:
  std::vector<Triangle> triangles_;
  std::shared_ptr<const RenderMesh> render_;
  std::vector<std::string> libraries_;
};

}  // namespace bem
