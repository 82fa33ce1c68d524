/// OBJ files, and what bodies need of them. Other formats are read by assimp, in a process of its
/// own that may crash.

#include "mesh/obj_reader.hpp"
#include "mesh/surface.hpp"
#include "mesh/triangulate.hpp"
#include "target.hpp"

namespace bem_fuzz {

bool run(const std::string& input) {
  constexpr std::size_t kMostTriangles = 2000;  // checks cost more than linear time
  return accepted([&] {
    bem::TriangleMesh mesh = bem::triangulate(bem::parse_obj(input, "input.obj"), "input.obj");
    if (mesh.triangles.size() < kMostTriangles) bem::make_surface(std::move(mesh), "input.obj");
  });
}

std::string repaired(std::string input) {
  return input;
}

}  // namespace bem_fuzz
