#include "mesh/describe.hpp"

namespace bem {

std::string to_text(const Vec3& point) {
  return "(" + to_text(point[0]) + ", " + to_text(point[1]) + ", " + to_text(point[2]) + ")";
}

std::string triangle_text(const TriangleMesh& input, std::size_t triangle) {
  const Triangle& t = input.triangles[triangle];
  return "triangle " + std::to_string(triangle) + " (vertices " + std::to_string(t[0]) + ", " +
         std::to_string(t[1]) + ", " + std::to_string(t[2]) + ")";
}

std::string vertex_text(const TriangleMesh& input, int vertex) {
  return "vertex " + std::to_string(vertex) + " at " + to_text(input.vertices[vertex]);
}

}  // namespace bem
