#include "assembly/vertex_fan.hpp"

#include "base/error.hpp"
#include "quadrature/free_term.hpp"
#include "quadrature/singular.hpp"

namespace bem {
namespace {

/// The other two vertices of a triangle, counter-clockwise after `vertex`.
std::pair<int, int> opposite_edge(const Triangle& t, int vertex) {
  for (int a = 0; a < 3; ++a)
    if (t[a] == vertex) return {t[(a + 1) % 3], t[(a + 2) % 3]};
  throw Error(ErrorCode::internal, "broken invariant: the triangle contains the vertex");
}

}  // namespace

VertexFans::VertexFans(const TriangleMesh& mesh) : mesh_(mesh), triangles_(mesh.vertices.size()) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int v : mesh.triangles[t]) triangles_[v].push_back(static_cast<int>(t));
}

std::vector<int> VertexFans::ring(int vertex) const {
  const std::vector<int>& fan = triangles_[vertex];
  require(!fan.empty(), "every vertex has triangles");
  std::vector<int> ring;
  int current = opposite_edge(mesh_.triangles[fan.front()], vertex).first;
  while (ring.size() < fan.size()) {
    ring.push_back(current);
    int next = -1;
    for (int t : fan) {
      const auto [from, to] = opposite_edge(mesh_.triangles[t], vertex);
      if (from == current) next = to;
    }
    require(next >= 0, "the triangles around a vertex form a closed fan");
    current = next;
  }
  require(current == ring.front(), "the triangles around a vertex form one closed fan");
  return ring;
}

std::vector<std::pair<int, Mat3>> VertexFans::static_blocks(int vertex, double kappa) const {
  const std::vector<int> neighbours = ring(vertex);
  const Vec3& x = mesh_.vertices[vertex];
  std::vector<Vec3> positions;
  for (int j : neighbours) positions.push_back(mesh_.vertices[j]);
  std::vector<std::pair<int, Mat3>> blocks;
  Mat3 own = free_term(x, positions, kappa);
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const std::size_t next = (i + 1) % neighbours.size();
    const VertexTriangle triangle(x, positions[i], positions[next]);
    own += triangle.static_traction_own(kappa);
    blocks.emplace_back(neighbours[i], triangle.static_traction(1, kappa));
    blocks.emplace_back(neighbours[next], triangle.static_traction(2, kappa));
  }
  blocks.emplace_back(vertex, own);
  return blocks;
}

}  // namespace bem
