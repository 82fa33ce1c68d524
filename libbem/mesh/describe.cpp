#include "mesh/describe.hpp"

#include <charconv>

namespace bem {

std::string to_text(double value) {
  char buffer[40];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

std::string rounded_text(double value, int digits) {
  char buffer[40];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr;
  return {buffer, end};
}

std::string to_text(const Vec3& point) {
  return "(" + to_text(point[0]) + ", " + to_text(point[1]) + ", " + to_text(point[2]) + ")";
}

std::string count_text(std::size_t count, const std::string& unit) {
  const std::string number = std::to_string(count) + " ";
  if (count == 1) return number + unit;
  if (unit.size() >= 6 && unit.substr(unit.size() - 6) == "vertex")
    return number + unit.substr(0, unit.size() - 2) + "ices";
  return number + unit + "s";
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
