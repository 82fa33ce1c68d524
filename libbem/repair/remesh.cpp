#include "repair/remesh.hpp"

#include "base/interruption.hpp"
#include "repair/cgal_mesh.hpp"

#include <cmath>

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>

namespace bem {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

constexpr int kTries = 6;
constexpr double kTolerance = 0.05;  ///< of the number of vertices
constexpr double kRefused = 0.98;    ///< times the length of edges whose mesh was not accepted
constexpr double kFar = 0.1;         ///< of the number of vertices, for a try from a finer mesh
constexpr double kFinerStart = 3;    ///< times the vertices of that
// Needles and caps that features near each other leave are collapsed and flipped.
constexpr double kCap = -0.94;      ///< cosine of an angle
constexpr double kNeedle = 4;       ///< longest edge over the shortest one
constexpr double kShortEdge = 0.2;  ///< of the edge length that is aimed at
constexpr double kManyTimes = 8;    ///< a mesh with so many times the vertices is thinned out first

/// Of the equilateral triangles with which so many nodes cover the area.
double edge_length(double area, double nodes) {
  return std::sqrt(2 * area / (std::sqrt(3.0) * nodes));
}

class Remesher {
 public:
  Remesher(const TriangleMesh& mesh, const RemeshTarget& target)
      : target_(target), area_(surface_area(mesh)) {
    std::optional<CgalMesh> cgal = cgal_mesh(mesh);
    if (!cgal) return;
    start_ = std::move(*cgal);
    valid_ = true;
    mark_features(start_);
    if (mesh.vertices.size() > kManyTimes * target.nodes)
      start_ = remeshed(edge_length(area_, 4.0 * target.nodes));
  }

  /// On regular meshes all edges are halved at the same length, so that some numbers of vertices
  /// are out of reach: then a finer mesh is thinned out.
  std::optional<TriangleMesh> run(const std::function<bool(const TriangleMesh&)>& accepts) {
    if (!valid_) return std::nullopt;
    adjust_length(accepts);
    if (best_ && error_of(*best_) <= kFar) return best_;
    start_ = remeshed(edge_length(area_, kFinerStart * target_.nodes));
    adjust_length(accepts);
    return best_;
  }

 private:
  using Sharp = CgalMesh::Property_map<CgalMesh::Edge_index, bool>;

  void adjust_length(const std::function<bool(const TriangleMesh&)>& accepts) {
    double length = edge_length(area_, target_.nodes);
    for (int i = 0; i < kTries; ++i) {
      check_interruption();
      CgalMesh result = remeshed(length);
      TriangleMesh mesh = from_cgal(result);
      const double count = static_cast<double>(mesh.vertices.size());
      if (count < 4) return;
      if ((!best_ || error_of(mesh) < error_of(*best_)) && accepts(mesh)) best_ = std::move(mesh);
      if (best_ && error_of(*best_) <= kTolerance) return;
      const double wrong = std::sqrt(count / target_.nodes);
      length *= std::abs(wrong - 1) < kTolerance / 2 ? kRefused : wrong;
    }
  }

  static Sharp sharp_edges(CgalMesh& mesh) {
    return mesh.add_property_map<CgalMesh::Edge_index, bool>("e:sharp", false).first;
  }

  void mark_features(CgalMesh& mesh) const {
    pmp::detect_sharp_edges(mesh, target_.feature_angle, sharp_edges(mesh));
  }

  double error_of(const TriangleMesh& mesh) const {
    return std::abs(static_cast<double>(mesh.vertices.size()) / target_.nodes - 1);
  }

  CgalMesh remeshed(double length) const {
    CgalMesh mesh = start_;
    pmp::isotropic_remeshing(mesh.faces(), length, mesh,
                             pmp::parameters::edge_is_constrained_map(sharp_edges(mesh))
                                 .number_of_iterations(3)
                                 .number_of_relaxation_steps(2)
                                 .relax_constraints(true));
    pmp::experimental::remove_almost_degenerate_faces(mesh, kCap, kNeedle, kShortEdge * length);
    mesh.collect_garbage();
    return mesh;
  }

  RemeshTarget target_;
  double area_;
  CgalMesh start_;
  std::optional<TriangleMesh> best_;  ///< accepted, with the nearest number of vertices
  bool valid_ = false;
};

}  // namespace

std::optional<TriangleMesh> remesh(const TriangleMesh& mesh, const RemeshTarget& target,
                                   const std::function<bool(const TriangleMesh&)>& accepts) {
  return without_failure([&] { return Remesher(mesh, target).run(accepts); });
}

}  // namespace bem
