#include "simulation/placement.hpp"

#include "mesh/bounding_box.hpp"
#include "mesh/free_travel.hpp"
#include "scene/motion.hpp"

#include <algorithm>

namespace bem {
namespace {

/// The body's surface in world axes, relative to the origin of its mesh.
TriangleMesh turned_surface(const BodySpec& body, const BodyGeometry& geometry) {
  TriangleMesh out = surface_at_rest(geometry);
  const Mat3 rotation = body.rotation.matrix();
  for (Vec3& x : out.vertices) x = rotation * x;
  return out;
}

/// All triangles of an obstacle at the start.
TriangleMesh placed_triangles(const MeshObstacle& obstacle, const ObstacleSurface& surface) {
  TriangleMesh out = surface.solid;
  const auto first = static_cast<int>(out.vertices.size());
  const TriangleMesh& sheet = surface.sheet.layers;
  out.vertices.insert(out.vertices.end(), sheet.vertices.begin(), sheet.vertices.end());
  for (const Triangle& t : sheet.triangles)
    out.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  out.vertices = placed_at(obstacle, out.vertices, 0);
  return out;
}

double travel_to_plane(const TriangleMesh& body, const PlaneObstacle& plane,
                       const Vec3& direction) {
  double farthest = direction.dot(body.vertices.front());
  for (const Vec3& x : body.vertices) farthest = std::max(farthest, direction.dot(x));
  return direction.dot(plane.point) - farthest;
}

/// How far the body gets along its direction until it touches its obstacle.
double travel_of(const TriangleMesh& body, const BodySpec& spec, const ObstacleSpec& obstacle,
                 ModelSource& source) {
  const Vec3& direction = *spec.place->direction;
  if (const auto* plane = std::get_if<PlaneObstacle>(&obstacle.shape))
    return travel_to_plane(body, *plane, direction);
  const auto& mesh = std::get<MeshObstacle>(obstacle.shape);
  const auto travel = free_travel(body, placed_triangles(mesh, source.obstacle(mesh)), direction);
  if (!travel)
    throw error_at(spec.place->location,
                   "the body " + in_quotes(spec.name) + " would fall past the obstacle " +
                       in_quotes(obstacle.name) + "; move its \"center\" to where the obstacle is");
  return *travel;
}

void place_body(const Scene& scene, BodySpec& body, const BodyGeometry& geometry,
                ModelSource& source) {
  const PlaceSpec& place = *body.place;
  TriangleMesh surface = turned_surface(body, geometry);
  body.position = place.centre + place.offset - bounding_box(surface.vertices).centre();
  if (!place.on.empty()) {
    for (Vec3& x : surface.vertices) x += body.position;
    const double travel = travel_of(surface, body, scene.obstacles[place.obstacle], source);
    // The part of a copy's offset that leads away from the obstacle is left between them.
    const double gap = *place.gap - place.offset.dot(*place.direction);
    body.position += (travel - gap) * *place.direction;
  }
  body.place.reset();
}

}  // namespace

void place_bodies(Scene& scene, const std::vector<const BodyGeometry*>& geometries,
                  ModelSource& source) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (scene.bodies[b].place) place_body(scene, scene.bodies[b], *geometries[b], source);
}

}  // namespace bem
