// Without GMP: its numbers decide in the rare cases that double precision leaves open, where those
// of CGAL do as well, and programs that use the library need not link it.
#define CGAL_DISABLE_GMP 1

#include "mesh/planar_triangles.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace bem {
namespace {

constexpr int kUnknown = -1000000;  // no region yet

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

/// The triangulation with the winding number of the loop as the info of each face.
class PlanarTriangulation {
 public:
  /// False if the loop crosses itself.
  bool insert(const std::vector<Eigen::Vector2d>& points, const std::vector<int>& loop) {
    std::vector<Cdt::Vertex_handle> vertices(points.size());
    Cdt::Face_handle near;
    for (std::size_t i = 0; i < points.size(); ++i) {
      vertices[i] = cdt_.insert(Cdt::Point(points[i].x(), points[i].y()), near);
      vertices[i]->info() = static_cast<int>(i);
      near = vertices[i]->face();
    }
    if (cdt_.number_of_vertices() != points.size() || cdt_.dimension() < 2) return false;
    try {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const int from = loop[k], to = loop[(k + 1) % loop.size()];
        cdt_.insert_constraint(vertices[from], vertices[to]);
        ++turns_[{from, to}];
        --turns_[{to, from}];
      }
    } catch (const Cdt::Intersection_of_constraints_exception&) {
      return false;
    }
    return true;
  }

  /// Winding numbers from the unbounded region inwards; false if an edge that the loop runs along
  /// is not one of its own, because a point lies on it.
  bool find_regions() {
    for (const Cdt::Face_handle f : cdt_.all_face_handles()) f->info() = kUnknown;
    std::vector<Cdt::Face_handle> reached{cdt_.infinite_face()};
    reached.front()->info() = 0;
    while (!reached.empty()) {
      const Cdt::Face_handle face = reached.back();
      reached.pop_back();
      for (int k = 0; k < 3; ++k) {
        const Cdt::Face_handle next = face->neighbor(k);
        int turns = 0;
        if (face->is_constrained(k) && !turns_across(face, k, turns)) return false;
        if (next->info() != kUnknown) continue;
        next->info() = face->info() - turns;
        reached.push_back(next);
      }
    }
    return true;
  }

  std::optional<std::vector<Triangle>> inner_triangles() const {
    std::vector<Triangle> triangles;
    for (const Cdt::Face_handle f : cdt_.finite_face_handles()) {
      if (f->info() == 0) continue;
      if (f->info() != 1) return std::nullopt;
      Triangle t{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()};
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      triangles.push_back(t);
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
  }

 private:
  /// How often the loop runs along edge k of the face with the face on its left, minus the other
  /// way round.
  bool turns_across(const Cdt::Face_handle face, int k, int& turns) const {
    const int from = face->vertex(Cdt::ccw(k))->info(), to = face->vertex(Cdt::cw(k))->info();
    const auto found = turns_.find({from, to});
    if (found == turns_.end()) return false;
    turns = found->second;
    return true;
  }

  Cdt cdt_;
  std::map<std::pair<int, int>, int> turns_;  ///< of each directed edge of the loop
};

}  // namespace

std::optional<std::vector<Triangle>> planar_triangles(const std::vector<Eigen::Vector2d>& points,
                                                      const std::vector<int>& loop) {
  PlanarTriangulation triangulation;
  if (!triangulation.insert(points, loop) || !triangulation.find_regions()) return std::nullopt;
  return triangulation.inner_triangles();
}

}  // namespace bem
