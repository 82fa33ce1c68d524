#pragma once

#include "support/simulate.hpp"

namespace bem_test {

inline bem::ObstacleSpec plane(const bem::Vec3& point, const bem::Vec3& normal, double friction) {
  bem::ObstacleSpec o;
  o.name = "floor";
  o.shape = bem::PlaneObstacle{point, normal.normalized()};
  o.friction = friction;
  return o;
}

inline bem::ObstacleSpec mesh_obstacle(const std::string& mesh, double friction) {
  bem::ObstacleSpec o;
  o.name = mesh;
  bem::MeshObstacle shape;
  shape.mesh.resolved = shape.mesh.written = mesh;
  o.shape = shape;
  o.friction = friction;
  return o;
}

/// A horizontal square sheet of triangles around the origin.
inline bem::TriangleMesh sheet(double size, int cells) {
  bem::TriangleMesh mesh;
  const double cell = size / cells;
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j)
      mesh.vertices.emplace_back(cell * i - size / 2, cell * j - size / 2, 0);
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const int a = i * (cells + 1) + j, b = a + cells + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

inline bem::BodySpec body(const std::string& name, const std::string& archive,
                          const bem::Vec3& position) {
  bem::BodySpec b;
  b.name = name;
  b.archive.resolved = b.archive.written = archive;
  b.position = position;
  return b;
}

inline bem::BodyModel rigid_model(bem::TriangleMesh mesh, double density) {
  bem::PrecomputeOptions o;
  o.kind = bem::ModelKind::rigid;
  o.discretisation.material = material(density, 1e6, 0.3);
  return bem::precompute(geometry_of(std::move(mesh), density), o);
}

inline bem::BodyModel elastic_model(bem::TriangleMesh mesh, const bem::Material& m, double dt,
                                    const char* scheme = "radau2") {
  const bem::BodyGeometry g = geometry_of(std::move(mesh), m.density);
  bem::PrecomputeOptions o = options_for(g, m, scheme, g.extent / (m.shear_speed() * dt));
  o.discretisation.dt = dt;
  return bem::precompute(g, o);
}

/// A scene with contact.
inline bem::Scene contact_scene(double time_step, const bem::Vec3& gravity) {
  bem::Scene scene;
  scene.time_step = time_step;
  scene.gravity = gravity;
  scene.contact.enabled = true;
  return scene;
}

inline bem::Vec3 total_contact_force(const bem::Simulation& simulation) {
  bem::Vec3 sum = bem::Vec3::Zero();
  for (const bem::Vec3& f : simulation.contact_forces()) sum += f;
  return sum;
}

inline bem::Vec3 linear_momentum(const bem::Simulation& simulation) {
  bem::Vec3 sum = bem::Vec3::Zero();
  for (const bem::Body& b : simulation.bodies()) sum += b.linear_momentum();
  return sum;
}

/// About the origin of the world.
inline bem::Vec3 angular_momentum(const bem::Simulation& simulation) {
  bem::Vec3 sum = bem::Vec3::Zero();
  for (const bem::Body& b : simulation.bodies())
    sum += b.frame().angular_momentum() + b.frame().translation().cross(b.linear_momentum());
  return sum;
}

}  // namespace bem_test
