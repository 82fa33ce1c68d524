#include "repair/orient_patches.hpp"

#include "mesh/adjacency.hpp"
#include "mesh/weld.hpp"
#include "repair/disjoint_sets.hpp"

#include <utility>

namespace bem {
namespace {

class Patches {
 public:
  explicit Patches(TriangleMesh& mesh) : mesh_(mesh), links_(mesh.triangles.size()) {
    for_each_edge(sorted_half_edges(mesh.triangles),
                  [&](const HalfEdge* first, const HalfEdge* last) {
                    if (last - first == 2) link(first[0], first[1]);
                  });
  }

  OrientedPatches orient() {
    turned_.assign(mesh_.triangles.size(), -1);
    for (std::size_t t = 0; t < turned_.size(); ++t)
      if (turned_[t] < 0) visit_patch(static_cast<int>(t));
    OrientedPatches result;
    result.turned = static_cast<std::size_t>(std::count(turned_.begin(), turned_.end(), 1));
    result.split = number_fans();
    return result;
  }

 private:
  struct Link {
    int triangle;
    bool same;  ///< both run along their edge in opposite directions, as they should
    std::array<std::pair<int, int>, 2> corners;  ///< own corner and the neighbour's at each end
  };

  int corner_at(int triangle, int vertex) const {
    const Triangle& t = mesh_.triangles[triangle];
    return 3 * triangle + static_cast<int>(std::find(t.begin(), t.end(), vertex) - t.begin());
  }

  void link(const HalfEdge& a, const HalfEdge& b) {
    const int s = a.index / 3, t = b.index / 3;
    const bool same = a.forward != b.forward;
    const std::pair<int, int> low{corner_at(s, a.low), corner_at(t, a.low)};
    const std::pair<int, int> high{corner_at(s, a.high), corner_at(t, a.high)};
    links_[s].push_back({t, same, {low, high}});
    links_[t].push_back(
        {s,
         same,
         {std::make_pair(low.second, low.first), std::make_pair(high.second, high.first)}});
  }

  /// Turns the triangles of a patch like its first one, or the others if these are fewer.
  void visit_patch(int first) {
    std::vector<int> patch{first};
    turned_[first] = 0;
    for (std::size_t i = 0; i < patch.size(); ++i)
      for (const Link& link : links_[patch[i]]) {
        if (turned_[link.triangle] >= 0) continue;
        turned_[link.triangle] = link.same ? turned_[patch[i]] : 1 - turned_[patch[i]];
        patch.push_back(link.triangle);
      }
    std::size_t turned = 0;
    for (int t : patch) turned += turned_[t];
    if (2 * turned <= patch.size()) return;
    for (int t : patch) turned_[t] = 1 - turned_[t];
  }

  /// Corners that links of one orientation connect become one vertex.
  std::size_t number_fans() {
    DisjointSets corners(3 * mesh_.triangles.size());
    for (std::size_t t = 0; t < links_.size(); ++t)
      for (const Link& link : links_[t])
        if (link.same == (turned_[t] == turned_[link.triangle]))
          for (const auto& [own, other] : link.corners) corners.unite(own, other);
    std::vector<char> taken(mesh_.vertices.size(), 0);
    std::vector<int> number(3 * mesh_.triangles.size(), -1);
    const std::size_t before = mesh_.vertices.size();
    for (std::size_t c = 0; c < number.size(); ++c) {
      int& vertex = mesh_.triangles[c / 3][c % 3];
      int& n = number[corners.find(static_cast<int>(c))];
      if (n < 0) n = taken[vertex] ? copy_of(vertex) : vertex;
      taken[vertex] = 1;
      vertex = n;
    }
    for (std::size_t t = 0; t < turned_.size(); ++t)
      if (turned_[t]) std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]);
    return mesh_.vertices.size() - before;
  }

  int copy_of(int vertex) {
    const Vec3 place = mesh_.vertices[vertex];
    mesh_.vertices.push_back(place);
    return static_cast<int>(mesh_.vertices.size()) - 1;
  }

  TriangleMesh& mesh_;
  std::vector<std::vector<Link>> links_;
  std::vector<signed char> turned_;  ///< -1: not visited
};

}  // namespace

OrientedPatches orient_patches(TriangleMesh& mesh) {
  return Patches(mesh).orient();
}

std::size_t separate_vertices(TriangleMesh& mesh, double part) {
  std::vector<Vec3> sum(mesh.vertices.size(), Vec3::Zero());
  std::vector<int> count(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      sum[t[k]] += mesh.vertices[t[(k + 1) % 3]] + mesh.vertices[t[(k + 2) % 3]];
      count[t[k]] += 2;
    }
  std::vector<int> used;
  for (std::size_t v = 0; v < count.size(); ++v)
    if (count[v] > 0) used.push_back(static_cast<int>(v));
  const std::vector<int> first = first_at_position(mesh.vertices, used);
  std::vector<char> shared(count.size(), 0);
  for (int v : used)
    if (first[v] != v) shared[v] = shared[first[v]] = 1;
  std::size_t moved = 0;
  std::vector<Vec3> places = mesh.vertices;
  for (int v : used)
    if (shared[v]) {
      places[v] += part * (sum[v] / count[v] - mesh.vertices[v]);
      ++moved;
    }
  mesh.vertices = std::move(places);
  return moved;
}

}  // namespace bem
