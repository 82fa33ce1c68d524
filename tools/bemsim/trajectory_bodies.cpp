#include "trajectory_bodies.hpp"

#include "base/error.hpp"
#include "dynamics/body_output.hpp"
#include "mesh/describe.hpp"

#include <algorithm>

namespace bem {
namespace {

bool writes_tractions(const Scene& scene) {
  const auto& fields = scene.output.fields;
  return std::find(fields.begin(), fields.end(), OutputField::tractions) != fields.end();
}

bool writes_simulated_surface(const Plan& plan, const PlannedBody& body) {
  if (body.shows_surface) return false;
  return !body.render || plan.scene.output.surface == OutputSurface::both;
}

TrajectoryBody simulated_body(const PlannedBody& body, bool tractions) {
  const TriangleMesh& mesh = body.archive->geometry().input;
  TrajectoryBody out{body.spec->name, mesh.vertices.size(), mesh.triangles, tractions,
                     mesh.vertices};
  if (!body.render) return out;
  out.name = simulation_name(out.name);
  out.surface = TrajectorySurface::simulation;
  return out;
}

TrajectoryBody render_body(const PlannedBody& body, bool tractions) {
  const TriangleMesh& mesh = body.render->mesh()->triangles;
  const TrajectorySurface surface =
      body.shows_surface ? TrajectorySurface::only : TrajectorySurface::render;
  return {body.spec->name, mesh.vertices.size(), mesh.triangles, tractions, mesh.vertices,
          surface,         body.render->mesh()};
}

/// The frame is that of the mesh coordinates: without displacements a vertex with mesh coordinates
/// x is at translation + rotation * x.
BodyFrame place_of(const BodySpec& spec, const Body& body) {
  BodyFrame out;
  if (spec.frame == FrameMotion::stationary) {
    out.rotation = spec.rotation.matrix();
    out.translation = spec.position;
  } else {
    out.rotation = body.frame().rotation();
    out.translation = body.frame().translation() - out.rotation * body.model().geometry.mass.centre;
  }
  return out;
}

BodyFrame simulated_frame(BodyFrame out, const Body& body, bool tractions) {
  out.positions = BodyOutput(body).positions();
  if (tractions) out.tractions = BodyOutput(body).tractions();
  return out;
}

BodyFrame render_frame(BodyFrame out, const BoundMesh& mesh, const Body& body, bool tractions) {
  BoundMesh::Shape shape = mesh.shape(BodyOutput(body).node_positions());
  out.positions = std::move(shape.positions);
  out.normals = std::move(shape.normals);
  if (tractions) out.tractions = mesh.binding().interpolate(BodyOutput(body).node_tractions());
  return out;
}

/// Of a render mesh that is the simulated surface: normals alone have to be found for it.
BodyFrame surface_frame(BodyFrame out, const BoundMesh& mesh, const Body& body, bool tractions) {
  if (!mesh.mesh()->obj.normals().empty())
    out.normals = mesh.shape(BodyOutput(body).node_positions()).normals;
  return simulated_frame(std::move(out), body, tractions);
}

/// What is on the disk is always finite.
void check_finite(const Body& body, const BodyFrame& frame, double time) {
  const auto finite = [](const std::vector<Vec3>& vectors) {
    return std::all_of(vectors.begin(), vectors.end(), [](const Vec3& v) { return v.allFinite(); });
  };
  if (!finite(frame.positions) || !finite(frame.tractions) || !finite(frame.normals) ||
      !frame.translation.allFinite() || !frame.rotation.allFinite())
    throw Error(ErrorCode::numerical,
                "body " + in_quotes(body.name()) +
                    " has a number that is not finite at t = " + to_text(time) + " s");
}

}  // namespace

std::vector<TrajectoryBody> trajectory_bodies(const Plan& plan) {
  const bool tractions = writes_tractions(plan.scene);
  std::vector<TrajectoryBody> bodies;
  for (const PlannedBody& body : plan.bodies) {
    if (body.render) bodies.push_back(render_body(body, tractions));
    if (writes_simulated_surface(plan, body)) bodies.push_back(simulated_body(body, tractions));
  }
  return bodies;
}

std::vector<BodyFrame> body_frames(const Plan& plan, const Simulation& simulation) {
  const bool tractions = writes_tractions(plan.scene);
  std::vector<BodyFrame> frames;
  const auto add = [&](const Body& body, BodyFrame frame) {
    check_finite(body, frame, simulation.time());
    frames.push_back(std::move(frame));
  };
  for (std::size_t i = 0; i < plan.bodies.size(); ++i) {
    const PlannedBody& planned = plan.bodies[i];
    const Body& body = simulation.bodies()[i];
    const BodyFrame place = place_of(*planned.spec, body);
    if (planned.shows_surface)
      add(body, surface_frame(place, *planned.render, body, tractions));
    else if (planned.render)
      add(body, render_frame(place, *planned.render, body, tractions));
    if (writes_simulated_surface(plan, planned)) add(body, simulated_frame(place, body, tractions));
  }
  return frames;
}

}  // namespace bem
