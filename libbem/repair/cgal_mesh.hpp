#pragma once

// For sources of this folder alone: no other header shows CGAL. Without GMP, see
// mesh/planar_triangles.cpp.
#define CGAL_DISABLE_GMP 1

#include "mesh/triangle_mesh.hpp"

#include <optional>
#include <stdexcept>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/assertions_behaviour.h>

namespace bem {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<CgalKernel::Point_3>;

inline CgalKernel::Point_3 cgal_point(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

/// The mesh must be a manifold, with or without a boundary, of consistent orientation; empty if it
/// is not.
inline std::optional<CgalMesh> cgal_mesh(const TriangleMesh& mesh) {
  CgalMesh result;
  for (const Vec3& p : mesh.vertices) result.add_vertex(cgal_point(p));
  using Vertex = CgalMesh::Vertex_index;
  for (const Triangle& t : mesh.triangles)
    if (result.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])) == CgalMesh::null_face())
      return std::nullopt;
  return result;
}

/// Vertices and faces in their order, without those that were removed.
inline TriangleMesh from_cgal(CgalMesh& mesh) {
  mesh.collect_garbage();
  TriangleMesh result;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    result.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : mesh.faces()) {
    Triangle t{};
    int k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) t[k++] = static_cast<int>(v);
    result.triangles.push_back(t);
  }
  return result;
}

/// Keeps CGAL from printing what fails as long as it lives.
class SilentCgal {
 public:
  SilentCgal()
      : error_(CGAL::set_error_handler(&silent)), warning_(CGAL::set_warning_handler(&silent)) {}
  ~SilentCgal() {
    CGAL::set_error_handler(error_);
    CGAL::set_warning_handler(warning_);
  }
  SilentCgal(const SilentCgal&) = delete;
  SilentCgal& operator=(const SilentCgal&) = delete;

 private:
  static void silent(const char*, const char*, const char*, int, const char*) {}

  CGAL::Failure_function error_, warning_;
};

/// What `work` returns, an optional, or nothing if CGAL finds that something does not hold that it
/// counts on.
template <typename Work>
auto without_failure(Work work) -> decltype(work()) {
  const SilentCgal silent;
  try {
    return work();
  } catch (const std::logic_error&) {  // CGAL::Failure_exception
    return std::nullopt;
  }
}

}  // namespace bem
