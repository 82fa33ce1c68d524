#include "output/trajectory_contents.hpp"

#include "base/error.hpp"

#include <set>

namespace bem {
namespace {

void check_triangles(const std::vector<Triangle>& triangles, std::size_t vertices) {
  for (const Triangle& t : triangles)
    for (int v : t)
      require(v >= 0 && static_cast<std::size_t>(v) < vertices,
              "the triangles of a trajectory refer to its vertices");
}

}  // namespace

void check_contents(const TrajectoryContents& contents) {
  std::set<std::string> names;
  const auto check_name = [&](const std::string& name) {
    require(!name.empty() && name != "." && name != ".." &&
                name.find_first_of(std::string("/\0", 2)) == std::string::npos,
            "the name of a body can be used for files");
    require(names.insert(name).second, "no two bodies of a trajectory share a name");
  };
  for (const TrajectoryBody& body : contents.bodies) {
    check_name(body.name);
    check_triangles(body.triangles, body.vertices);
  }
  for (const TrajectoryObstacle& obstacle : contents.obstacles) {
    check_name(obstacle.name);
    check_triangles(obstacle.triangles, obstacle.vertices.size());
  }
}

void check_rest(const std::vector<TrajectoryBody>& bodies) {
  for (const TrajectoryBody& body : bodies)
    require(body.rest.size() == body.vertices, "a body brings every vertex of its mesh");
}

}  // namespace bem
