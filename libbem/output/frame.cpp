#include "output/frame.hpp"

#include "base/error.hpp"
#include "render/render_mesh.hpp"

#include <set>

namespace bem {

void check_bodies(const std::vector<TrajectoryBody>& bodies) {
  std::set<std::string> names;
  for (const TrajectoryBody& body : bodies) {
    require(!body.name.empty() && body.name != "." && body.name != ".." &&
                body.name.find_first_of(std::string("/\0", 2)) == std::string::npos,
            "the name of a body can be used for files");
    require(names.insert(body.name).second, "no two bodies of a trajectory share a name");
    for (const Triangle& t : body.triangles)
      for (int v : t)
        require(v >= 0 && static_cast<std::size_t>(v) < body.vertices,
                "the triangles of a trajectory refer to its vertices");
  }
}

void check_rest(const std::vector<TrajectoryBody>& bodies) {
  for (const TrajectoryBody& body : bodies)
    require(body.rest.size() == body.vertices, "a body brings every vertex of its mesh");
}

void check_frame(const std::vector<TrajectoryBody>& bodies, const Frame& frame) {
  require(frame.bodies.size() == bodies.size(), "a frame holds every body");
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    require(frame.bodies[i].positions.size() == bodies[i].vertices,
            "a frame holds the position of every vertex");
    require(!bodies[i].tractions || frame.bodies[i].tractions.size() == bodies[i].vertices,
            "a frame holds the traction of every vertex");
    require(!bodies[i].render ||
                frame.bodies[i].normals.size() == bodies[i].render->obj.normals().size(),
            "a frame holds every normal of a render mesh");
  }
}

}  // namespace bem
