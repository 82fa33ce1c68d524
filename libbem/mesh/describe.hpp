#pragma once

#include "mesh/triangle_mesh.hpp"

#include <string>

namespace bem {

/// Words for messages about meshes. Numbers are written so that they read back exactly, whatever
/// the locale.
std::string to_text(double value);
std::string to_text(const Vec3& point);  ///< "(x, y, z)"
/// The same to so many significant digits.
std::string rounded_text(double value, int digits);

/// "1 edge", "3 edges": `unit` in the singular.
std::string count_text(std::size_t count, const std::string& unit);

/// "triangle 5 (vertices 1, 7, 4)"; indices count from 0, as in the input.
std::string triangle_text(const TriangleMesh& input, std::size_t triangle);

/// "vertex 7 at (x, y, z)".
std::string vertex_text(const TriangleMesh& input, int vertex);

}  // namespace bem
