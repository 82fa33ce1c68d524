#include "mesh/weld.hpp"

#include <algorithm>
#include <utility>

namespace bem {

std::vector<int> first_at_position(const std::vector<Vec3>& p, std::vector<int> members) {
  const auto before = [&](int a, int b) {
    for (int k = 0; k < 3; ++k)
      if (p[a][k] != p[b][k]) return p[a][k] < p[b][k];
    return a < b;
  };
  std::sort(members.begin(), members.end(), before);
  std::vector<int> first(p.size(), -1);
  for (std::size_t i = 0; i < members.size(); ++i) {
    const bool repeats = i > 0 && p[members[i]] == p[members[i - 1]];
    first[members[i]] = repeats ? first[members[i - 1]] : members[i];
  }
  return first;
}

Welded weld(const TriangleMesh& mesh) {
  const std::vector<Vec3>& p = mesh.vertices;
  std::vector<char> used(p.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (int v : t) used[v] = 1;
  std::vector<int> members;
  for (int v = 0; v < static_cast<int>(p.size()); ++v)
    if (used[v]) members.push_back(v);
  const std::vector<int> first = first_at_position(p, std::move(members));

  Welded result;
  result.node_of_vertex.assign(p.size(), -1);
  for (int v = 0; v < static_cast<int>(p.size()); ++v) {
    if (!used[v]) continue;
    if (first[v] == v) {
      result.node_of_vertex[v] = static_cast<int>(result.mesh.vertices.size());
      result.mesh.vertices.push_back(p[v]);
    } else {
      result.node_of_vertex[v] = result.node_of_vertex[first[v]];
    }
  }
  result.mesh.triangles = mesh.triangles;
  for (Triangle& t : result.mesh.triangles)
    for (int& v : t) v = result.node_of_vertex[v];
  return result;
}

}  // namespace bem
