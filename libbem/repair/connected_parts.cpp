#include "repair/connected_parts.hpp"

#include "mesh/weld.hpp"
#include "repair/disjoint_sets.hpp"

namespace bem {

std::vector<TriangleMesh> connected_parts(const TriangleMesh& mesh) {
  const TriangleMesh nodes = weld(mesh).mesh;
  DisjointSets groups(nodes.vertices.size());
  for (const auto& [a, b, c] : nodes.triangles) {
    groups.unite(a, b);
    groups.unite(b, c);
  }
  std::vector<TriangleMesh> parts;
  std::vector<int> number(nodes.vertices.size(), -1);  // of the part of a group
  std::vector<int> index(nodes.vertices.size(), 0);    // of a vertex in its part
  for (const Triangle& t : nodes.triangles) {
    int& n = number[groups.find(t[0])];
    if (n < 0) {
      n = static_cast<int>(parts.size());
      parts.emplace_back();
    }
    parts[n].triangles.push_back(t);
  }
  for (std::size_t v = 0; v < nodes.vertices.size(); ++v) {
    std::vector<Vec3>& own = parts[number[groups.find(static_cast<int>(v))]].vertices;
    index[v] = static_cast<int>(own.size());
    own.push_back(nodes.vertices[v]);
  }
  for (TriangleMesh& part : parts)
    for (Triangle& t : part.triangles)
      for (int& v : t) v = index[v];
  return parts;
}

}  // namespace bem
