#include "mesh/solids.hpp"

#include "base/error.hpp"
#include "mesh/describe.hpp"

#include <algorithm>

namespace bem {

std::vector<std::vector<int>> find_solids(const Surface& surface) {
  const std::vector<Component>& components = surface.components;
  std::vector<std::vector<int>> parts(components.size());
  for (std::size_t c = 0; c < components.size(); ++c) {
    const Component& component = components[c];
    std::vector<int>& part = parts[component.is_solid() ? c : component.parent];
    part.insert(part.end(), component.triangles.begin(), component.triangles.end());
  }
  std::vector<std::vector<int>> solids;
  for (std::vector<int>& part : parts) {
    std::sort(part.begin(), part.end());
    if (!part.empty()) solids.push_back(std::move(part));
  }
  std::sort(solids.begin(), solids.end());
  return solids;
}

void check_single_solid(const Surface& surface, const std::string& source) {
  const std::vector<std::vector<int>> solids = find_solids(surface);
  if (solids.size() <= 1) return;
  throw Error(
      ErrorCode::invalid_input,
      source + ": " + std::to_string(solids.size()) + " separate solids, the second begins at " +
          triangle_text(surface.input, solids[1].front()) +
          " (counting from 0): no material connects them, so they cannot be one body; make "
          "one of each with \"bemshape split " +
          source + " -o 'part-%d.obj'\", or unite them in the program that the mesh comes from");
}

TriangleMesh part_of(const Surface& surface, const std::vector<int>& triangles) {
  std::vector<int> index(surface.nodes.vertices.size(), -1);
  TriangleMesh part;
  for (int t : triangles) {
    part.triangles.push_back(surface.nodes.triangles[t]);
    for (int v : part.triangles.back()) index[v] = 0;
  }
  for (std::size_t v = 0; v < index.size(); ++v) {
    if (index[v] < 0) continue;
    index[v] = static_cast<int>(part.vertices.size());
    part.vertices.push_back(surface.nodes.vertices[v]);
  }
  for (Triangle& t : part.triangles)
    for (int& v : t) v = index[v];
  return part;
}

}  // namespace bem
