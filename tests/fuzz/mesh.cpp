/// OBJ and OFF files (what begins with "OFF"), and what bodies and obstacles need of them. Other
/// formats are read by assimp, in a process of its own that may crash.

#include "mesh/obj_reader.hpp"
#include "mesh/obstacle_surface.hpp"
#include "mesh/off_reader.hpp"
#include "mesh/surface.hpp"
#include "mesh/triangulate.hpp"
#include "target.hpp"

namespace bem_fuzz {

bool run(const std::string& input) {
  constexpr std::size_t kMostCorners = 6000;  // checks cost more than linear time
  return accepted([&] {
    bem::PolygonMesh polygons = input.compare(0, 3, "OFF") == 0
                                    ? bem::parse_off(input, "input.off")
                                    : bem::parse_obj(input, "input.obj");
    if (polygons.corners.size() > kMostCorners) return;
    const bem::TriangleMesh mesh = bem::triangulate(std::move(polygons), "input");
    accepted([&] { bem::make_obstacle_surface(mesh, "input"); });
    bem::make_surface(mesh, "input");
  });
}

std::string repaired(std::string input) {
  return input;
}

}  // namespace bem_fuzz
