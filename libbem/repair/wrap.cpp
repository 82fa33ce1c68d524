#include "repair/wrap.hpp"

#include "repair/cgal_mesh.hpp"

#include <CGAL/alpha_wrap_3.h>

namespace bem {

std::optional<TriangleMesh> alpha_wrap(const TriangleMesh& mesh, double alpha, double offset) {
  return without_failure([&]() -> std::optional<TriangleMesh> {
    std::vector<CgalKernel::Point_3> points;
    for (const Vec3& p : mesh.vertices) points.push_back(cgal_point(p));
    CgalMesh result;
    CGAL::alpha_wrap_3(points, mesh.triangles, alpha, offset, result);
    return from_cgal(result);
  });
}

}  // namespace bem
