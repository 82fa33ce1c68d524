#include "render_meshes.hpp"

#include "mesh/describe.hpp"
#include "preparation/archive_match.hpp"

#include <algorithm>
#include <map>

namespace bem {
namespace {

constexpr double kFar = 0.05;  // of the size

double relative_distance(const PlannedBody& body) {
  return body.render->binding().farthest() / body.archive->geometry().extent;
}

/// "up to 0.001 m from the simulated surface (0.1 % of the size)".
std::string distance_text(const PlannedBody& body) {
  return "up to " + rounded_text(body.render->binding().farthest(), 3) +
         " m from the simulated surface (" + rounded_text(100 * relative_distance(body), 2) +
         " % of the size)";
}

std::shared_ptr<const BoundMesh> bind(const PlannedBody& body) {
  const FilePath& path = *body.spec->render_mesh;
  const double scale = body.archive->provenance().mesh_scale;
  auto mesh = at_place(path.location, [&] {
    return std::make_shared<const RenderMesh>(read_render_mesh(path.resolved, scale));
  });
  return std::make_shared<const BoundMesh>(std::move(mesh),
                                           surface_at_rest(body.archive->geometry()));
}

/// Whether files get more of a mesh than its triangles.
bool writes_faces(const OutputSpec& output) {
  const OutputFormat* const triangles_alone = find_output_format("hdf5");
  return std::any_of(output.formats.begin(), output.formats.end(),
                     [&](const OutputFormat* format) { return format != triangles_alone; });
}

/// A body that is given by a mesh shows that mesh where it is not what is simulated, or where files
/// have its faces.
void show_own_meshes(Plan& plan) {
  for (std::size_t b = 0; b < plan.bodies.size(); ++b) {
    BodySpec& spec = plan.scene.bodies[b];
    const bool repaired = is_repaired(*plan.bodies[b].archive);
    if (spec.render_mesh || !spec.source || !(repaired || writes_faces(plan.scene.output)))
      continue;
    spec.render_mesh = spec.source->mesh;
    plan.bodies[b].shows_surface = !repaired;
  }
}

}  // namespace

void plan_render_meshes(Plan& plan) {
  if (plan.scene.output.surface == OutputSurface::simulation) return;
  show_own_meshes(plan);
  std::map<std::pair<const Archive*, std::string>, std::shared_ptr<const BoundMesh>> bound;
  for (PlannedBody& body : plan.bodies) {
    if (!body.spec->render_mesh) continue;
    auto& mesh = bound[{body.archive, body.spec->render_mesh->resolved}];
    const bool is_new = !mesh;
    if (is_new) mesh = bind(body);
    body.render = mesh;
    const bool chosen =
        !body.spec->source || body.spec->source->mesh.resolved != body.spec->render_mesh->resolved;
    if (is_new && chosen && relative_distance(body) > kFar)
      plan.warnings.push_back(where(body.spec->render_mesh->location) +
                              ": vertices of the render mesh are " + distance_text(body) +
                              ": is it a mesh of this body, in the same place and unit?");
  }
}

std::string render_mesh_text(const PlannedBody& body) {
  return "render mesh " + printable(body.spec->render_mesh->written) + ": " +
         count_text(body.render->mesh()->triangles.vertices.size(), "vertex") + ", " +
         distance_text(body);
}

}  // namespace bem
