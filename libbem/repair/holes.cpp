#include "repair/holes.hpp"

#include "base/interruption.hpp"
#include "repair/cgal_mesh.hpp"
#include "repair/disjoint_sets.hpp"

#include <iterator>

#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/boost/graph/Euler_operations.h>

namespace bem {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

using Halfedge = CgalMesh::Halfedge_index;
using Face = CgalMesh::Face_index;
using Vertex = CgalMesh::Vertex_index;

constexpr std::size_t kLongestLoop = 20000;  ///< edges; longer ones would take minutes

Vec3 to_vec(const CgalKernel::Point_3& p) {
  return {p.x(), p.y(), p.z()};
}

double area_of(const CgalMesh& mesh, Face f) {
  const Halfedge h = mesh.halfedge(f);
  return area_vector(to_vec(mesh.point(mesh.source(h))), to_vec(mesh.point(mesh.target(h))),
                     to_vec(mesh.point(mesh.target(mesh.next(h)))))
      .norm();
}

class HoleFiller {
 public:
  HoleFiller(CgalMesh& mesh, double part) : mesh_(mesh), part_(part), groups_(mesh.num_faces()) {
    for (const auto e : mesh.edges())
      if (!mesh.is_border(e))
        groups_.unite(static_cast<int>(mesh.face(mesh.halfedge(e, 0))),
                      static_cast<int>(mesh.face(mesh.halfedge(e, 1))));
    areas_.assign(mesh.num_faces(), 0);
    for (const Face f : mesh.faces()) areas_[groups_.find(static_cast<int>(f))] += area_of(mesh, f);
  }

  FilledHoles fill() {
    for (const Halfedge h : loops()) {
      check_interruption();
      fill(h);
    }
    out_.mesh = from_cgal(mesh_);
    return std::move(out_);
  }

 private:
  /// One half-edge of each closed line of open edges.
  std::vector<Halfedge> loops() const {
    std::vector<char> seen(mesh_.number_of_halfedges(), 0);
    std::vector<Halfedge> found;
    for (const Halfedge h : mesh_.halfedges()) {
      if (!mesh_.is_border(h) || seen[h]) continue;
      found.push_back(h);
      for (Halfedge g = h; !seen[g]; g = mesh_.next(g)) seen[g] = 1;
    }
    return found;
  }

  /// Length of the vector area: no surface that fills the loop has a smaller area.
  double least_area(Halfedge start, std::size_t& edges) const {
    const Vec3 origin = to_vec(mesh_.point(mesh_.target(start)));
    Vec3 sum = Vec3::Zero();
    edges = 0;
    Halfedge h = start;
    do {
      sum += area_vector(origin, to_vec(mesh_.point(mesh_.source(h))),
                         to_vec(mesh_.point(mesh_.target(h))));
      ++edges;
      h = mesh_.next(h);
    } while (h != start);
    return sum.norm();
  }

  void fill(Halfedge start) {
    std::size_t edges = 0;
    const double least = least_area(start, edges);
    const double whole = areas_[groups_.find(static_cast<int>(mesh_.face(mesh_.opposite(start))))];
    const double limit = part_ * whole;
    if (edges < 3 || edges > kLongestLoop || least > limit) return out_.left.push_back(edges);
    std::vector<Face> faces;
    std::vector<Vertex> vertices;
    pmp::triangulate_and_refine_hole(mesh_, start, std::back_inserter(faces),
                                     std::back_inserter(vertices));
    double area = 0;
    for (const Face f : faces) area += area_of(mesh_, f);
    if (faces.empty() || area > limit) {
      for (const Face f : faces) CGAL::Euler::remove_face(mesh_.halfedge(f), mesh_);
      return out_.left.push_back(edges);
    }
    out_.filled.push_back(edges);
    out_.area += area;
    out_.largest = std::max(out_.largest, area / whole);
  }

  CgalMesh& mesh_;
  double part_;
  DisjointSets groups_;        ///< faces of the mesh as it came, by connected part
  std::vector<double> areas_;  ///< of the groups
  FilledHoles out_;
};

}  // namespace

std::optional<FilledHoles> fill_holes(const TriangleMesh& mesh, double part) {
  return without_failure([&]() -> std::optional<FilledHoles> {
    std::optional<CgalMesh> cgal = cgal_mesh(mesh);
    if (!cgal) return std::nullopt;
    return HoleFiller(*cgal, part).fill();
  });
}

}  // namespace bem
