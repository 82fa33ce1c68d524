#include "mesh/mass_properties.hpp"

namespace bem {
namespace {

struct Corners {
  Vec3 a, b, c;
};

Corners relative_corners(const TriangleMesh& mesh, const Triangle& t, const Vec3& origin) {
  return {mesh.vertices[t[0]] - origin, mesh.vertices[t[1]] - origin, mesh.vertices[t[2]] - origin};
}

/// D = a . (b x c), six times the volume of the tetrahedron with the origin.
double determinant(const Corners& t) {
  return t.a.dot(t.b.cross(t.c));
}

}  // namespace

MassProperties mass_properties(const TriangleMesh& mesh, double density) {
  MassProperties result;
  // Any origin gives the same sums; one inside the box keeps cancellation small.
  const Vec3 origin = bounding_box(mesh.vertices).centre();
  Vec3 moment = Vec3::Zero();
  for (const Triangle& t : mesh.triangles) {
    const Corners corner = relative_corners(mesh, t, origin);
    const double d = determinant(corner);
    result.volume += d / 6.0;
    moment += d / 24.0 * (corner.a + corner.b + corner.c);
  }
  result.mass = density * result.volume;
  result.centre = origin + moment / result.volume;

  Mat3 second = Mat3::Zero();
  for (const Triangle& t : mesh.triangles) {
    const Corners corner = relative_corners(mesh, t, result.centre);
    const Vec3 sum = corner.a + corner.b + corner.c;
    second += determinant(corner) / 120.0 *
              (sum * sum.transpose() + corner.a * corner.a.transpose() +
               corner.b * corner.b.transpose() + corner.c * corner.c.transpose());
  }
  result.inertia = density * (second.trace() * Mat3::Identity() - second);
  return result;
}

std::vector<double> vertex_areas(const TriangleMesh& mesh) {
  std::vector<double> areas(mesh.vertices.size(), 0.0);
  for (const Triangle& t : mesh.triangles) {
    const double third = triangle_area(mesh, t) / 3.0;
    for (int v : t) areas[v] += third;
  }
  return areas;
}

std::vector<double> volume_weights(const TriangleMesh& mesh, const Vec3& centre) {
  // (y - centre) . n is constant on a flat triangle and int phi_i = area / 3.
  std::vector<double> weights(mesh.vertices.size(), 0.0);
  for (const Triangle& t : mesh.triangles) {
    const double share = determinant(relative_corners(mesh, t, centre)) / 6.0;
    for (int v : t) weights[v] += share;
  }
  return weights;
}

std::vector<Mat3> volume_centroid_weights(const TriangleMesh& mesh, const Vec3& centre) {
  // int y phi_i = area / 12 (2 y_i + y_j + y_k).
  std::vector<Mat3> weights(mesh.vertices.size(), Mat3::Zero());
  for (const Triangle& t : mesh.triangles) {
    const Corners corner = relative_corners(mesh, t, centre);
    const Vec3 sum = corner.a + corner.b + corner.c;
    const Vec3 normal = area_vector(mesh, t) / 12.0;
    weights[t[0]] += (corner.a + sum) * normal.transpose();
    weights[t[1]] += (corner.b + sum) * normal.transpose();
    weights[t[2]] += (corner.c + sum) * normal.transpose();
  }
  return weights;
}

}  // namespace bem
