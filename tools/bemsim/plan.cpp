#include "plan.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "common/measure.hpp"
#include "constraints/joint_plan.hpp"
#include "mesh/describe.hpp"
#include "render_meshes.hpp"
#include "scene/motion.hpp"
#include "scene/selection.hpp"
#include "simulation/initial_state.hpp"
#include "simulation/placement.hpp"
#include "simulation/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <set>

namespace bem {
namespace {

constexpr double kNoticeableGrowth = 1.0005;

void apply_options(const Options& o, Plan& plan) {
  Scene& scene = plan.scene;
  if (!o.formats.empty()) {
    scene.output.formats = o.formats;
    scene.output.location = {"--format", 0, 0, ""};
  }
  scene.output.formats = with_trajectory(scene.output.formats);
  if (o.steps) scene.duration = static_cast<double>(*o.steps) * scene.time_step;
  if (o.duration) scene.duration = *o.duration;
  if (scene.duration / scene.time_step > std::numeric_limits<int>::max())
    throw Error(ErrorCode::usage, "--duration is more than " +
                                      std::to_string(std::numeric_limits<int>::max()) +
                                      " time steps");
  if (o.every) scene.output.every = *o.every;
  plan.steps = o.steps ? *o.steps : step_count(scene.duration, scene.time_step);
  plan.schedule = o.fps ? FrameSchedule::per_second(*o.fps, scene.time_step)
                        : FrameSchedule::every_steps(scene.output.every);
  if (o.fps && *o.fps * scene.time_step > 1 + 1e-9)
    plan.warnings.push_back(
        "--fps asks for more frames than there are steps: every step is "
        "written, " +
        to_text(1 / scene.time_step) + " per second");
  if (plan.steps > 0 && plan.frames() == 1)
    plan.notes.push_back("frames are farther apart than the run is long, " +
                         count_text(static_cast<std::size_t>(plan.steps), "step") +
                         ": only the start is written (--every, --fps, \"every\")");
}

PlannedBody plan_body(const Scene& scene, const BodySpec& spec, ArchiveSource& source) {
  PlannedBody body{&spec, &source.open(spec.archive), 0, 0, {}, nullptr};
  check_archive(scene, spec, body.archive->kind(), body.archive->discretisation());
  const BodyGeometry& geometry = body.archive->geometry();
  for (const TractionSpec& load : spec.tractions)
    body.loaded.push_back(select_triangles(geometry, load.select).size());
  return body;
}

/// Reads the meshes of the obstacles.
void plan_obstacles(Plan& plan, ArchiveSource& source) {
  std::set<const ObstacleSurface*> seen;
  for (const ObstacleSpec& spec : plan.scene.obstacles) {
    const auto* mesh = std::get_if<MeshObstacle>(&spec.shape);
    plan.obstacles.push_back({&spec, mesh ? &source.obstacle(*mesh) : nullptr});
    if (!mesh || !seen.insert(plan.obstacles.back().surface).second) continue;
    for (const std::string& warning : plan.obstacles.back().surface->warnings)
      plan.warnings.push_back(where(spec.location) + ": " + warning);
  }
}

/// Whether the bodies can start as the scene says, and a note of what that means.
void check_initial_state(Plan& plan, const std::vector<Scheme>& schemes) {
  std::vector<StartingBody> bodies;
  for (std::size_t b = 0; b < plan.bodies.size(); ++b) {
    const Archive& archive = *plan.bodies[b].archive;
    bodies.push_back({plan.bodies[b].spec, archive.user_block().digest, &archive.geometry(),
                      archive.kind(), schemes[b].name(), plan.scene.time_step});
  }
  const InitialState state(plan.scene);
  state.check(bodies);
  plan.notes.push_back(state.text(bodies));
}

/// Matrices and columns of inputs are shared by the bodies of an archive, histories are not.
double memory_of(const std::vector<PlannedBody>& bodies, bool contact) {
  double bytes = 0;
  std::set<const Archive*> seen;
  for (const PlannedBody& body : bodies) {
    const Archive& archive = *body.archive;
    if (archive.kind() == ModelKind::rigid) continue;
    const Discretisation& d = archive.discretisation();
    const auto n = static_cast<double>(archive.unknowns());
    const auto lag_columns = static_cast<double>(d.scheme.lag_components().size()) *
                             static_cast<double>(d.history_length);
    const auto initial = static_cast<double>(d.scheme.initial_components().size());
    // matrices of surface loads are loaded as a whole where anything may be touched, else in part
    if (seen.insert(&archive).second) bytes += archive.matrix_bytes(contact);
    bytes += 4 * lag_columns * static_cast<double>(archive.history_coefficients());
    const double prescribed = 3 * static_cast<double>(body.fixed + body.handled);
    double inputs = 6 + 2 * prescribed + (body.spec->has_centrifugal() ? 6 : 0);
    for (const TractionSpec& load : body.spec->tractions)
      inputs += load.is_pressure() || load.follow ? 1 : 3;
    bytes += n * inputs * (8 * lag_columns + 16 * initial) + 8 * n * lag_columns +
             8 * prescribed * prescribed;
  }
  return bytes;
}

/// Whether the centrifugal force stretches a body so much that linear elasticity does not hold.
bool spins_fast(const PlannedBody& body) {
  constexpr double kFast = 0.5;
  if (!body.spec->has_centrifugal() || body.archive->kind() == ModelKind::rigid) return false;
  const double speed = body.spec->angular_velocity.norm() * body.archive->geometry().extent;
  return speed > kFast * body.archive->discretisation().material.shear_speed();
}

/// "left" and "right" joins 25 vertices.
std::string weld_text(const Plan& plan, const WeldPlan& weld) {
  const auto name = [&](std::size_t body) { return in_quotes(plan.scene.bodies[body].name); };
  return name(weld.spec->a.body) + " and " + name(weld.spec->b->body) + " joins " +
         count_text(weld.joined, "vertex");
}

void add_warnings(Plan& plan) {
  for (const std::string& warning : warnings_of_scene(plan.scene)) plan.warnings.push_back(warning);
  std::set<const Archive*> seen, old;
  for (const PlannedBody& body : plan.bodies) {
    const double growth = body.archive->report().growth * body.archive->window();
    if (growth > kNoticeableGrowth && seen.insert(body.archive).second)
      plan.warnings.push_back(
          where(body.spec->archive.location) + ": motions of this archive grow by a factor of " +
          to_text(growth) +
          " per step; make it again with --discretisation galerkin, --window auto "
          "or a larger --dt");
    if (body.spec->has_centrifugal() && !body.spec->angular_velocity.isZero(0) &&
        body.archive->kind() != ModelKind::rigid && !body.archive->has_centrifugal() &&
        old.insert(body.archive).second)
      plan.warnings.push_back(
          where(body.spec->archive.location) +
          ": this archive knows nothing of centrifugal forces: rotation will "
          "not stretch its bodies; make it again, or say \"centrifugal\": false");
    if (spins_fast(body))
      plan.warnings.push_back(where(body.spec->location) + ": the body " +
                              in_quotes(body.spec->name) +
                              " turns about as fast as it vibrates: its deformation will be wrong; "
                              "make it stiffer or slower, or say \"centrifugal\": false");
    if (body.spec->frame == FrameMotion::stationary && body.fixed + body.handled == 0)
      plan.warnings.push_back(
          where(body.spec->location) + ": nothing holds the body " + in_quotes(body.spec->name) +
          ", but its stationary frame is made for small displacements; a moving "
          "frame follows it");
  }
}

/// Contact sees an obstacle at the beginning and at the end of a step, and takes the way between
/// for straight.
void warn_of_fast_obstacles(Plan& plan) {
  constexpr double kMostTurn = kPi / 2;  // per step
  if (!plan.scene.contact.enabled) return;
  for (const ObstacleSpec& obstacle : plan.scene.obstacles) {
    const auto* mesh = std::get_if<MeshObstacle>(&obstacle.shape);
    if (!mesh) continue;
    const double turn = fastest_turn(mesh->motion) * plan.scene.time_step;
    if (turn > kMostTurn)
      plan.warnings.push_back(where(obstacle.location) + ": the obstacle " +
                              in_quotes(obstacle.name) + " turns by up to " +
                              to_text(std::round(turn * 180 / kPi)) +
                              " degrees in a time step, which contact does not see: it may pass "
                              "through bodies; use a shorter time step or a slower motion");
  }
}

void describe_welds(Plan& plan) {
  for (const WeldPlan& weld : plan.welds) {
    plan.notes.push_back("weld of " + weld_text(plan, weld));
    const std::string place = where(weld.spec->location) + ": the weld of " + weld_text(plan, weld);
    const bool within = weld.farthest <= weld.spec->tolerance;
    if (weld.nearly > 0)
      plan.warnings.push_back(place + "; " + nearly_text(weld) +
                              (within ? ", although that is within its \"tolerance\": the partner "
                                        "has been joined to another one; lower it below the "
                                        "distances between the vertices of one surface"
                                      : ": raise its \"tolerance\" to join them, or move them "
                                        "apart"));
    if (weld.alone > 0)
      plan.warnings.push_back(place + "; " + count_text(weld.alone, "vertex") + " of one surface " +
                              (weld.alone == 1 ? "lies" : "lie") +
                              " on the other where it has no vertex, and " +
                              (weld.alone == 1 ? "stays" : "stay") +
                              " free: give both surfaces the same vertices there");
  }
}

std::string vector_text(const Vec3& v, const char* unit) {
  return to_text(v) + " " + unit;
}

std::string box_text(const BoundingBox& box) {
  return to_text(box.min) + " to " + to_text(box.max);
}

void print_body(std::ostream& out, const PlannedBody& body, const Vec3& gravity) {
  const BodySpec& spec = *body.spec;
  const TriangleMesh& mesh = body.archive->geometry().input;
  const Discretisation& d = body.archive->discretisation();
  out << "body " << in_quotes(spec.name) << ": " << count_text(mesh.vertices.size(), "vertex")
      << ", " << count_text(mesh.triangles.size(), "triangle")
      << (spec.source ? ", mesh " : ", archive ")
      << printable(spec.source ? spec.source->mesh.written : spec.archive.written);
  if (body.archive->kind() == ModelKind::rigid)
    out << " (rigid)\n";
  else if (d.history_length == 0)
    out << " (static model, frame by " << d.scheme.name() << ")\n";
  else
    out << " (" << d.scheme.name() << ", history of "
        << count_text(static_cast<std::size_t>(d.history_length), "step") << ")\n";
  out << "  " << (spec.frame == FrameMotion::moving ? "moving" : "stationary") << " frame";
  if (spec.correction == Correction::least_squares) out << ", corrected by least squares";
  if (spec.gravity && !gravity.isZero(0)) out << ", gravity " << vector_text(gravity, "m/s^2");
  if (!spec.velocity.isZero(0)) out << ", velocity " << vector_text(spec.velocity, "m/s");
  if (!spec.angular_velocity.isZero(0))
    out << ", angular velocity " << vector_text(spec.angular_velocity, "rad/s");
  out << "\n";
  print_place(out, spec, body.archive->geometry());
  if (body.render) out << "  " << render_mesh_text(body) << "\n";
  if (body.fixed > 0) out << "  fixed: " << count_text(body.fixed, "vertex") << "\n";
  if (body.handled > 0)
    out << "  handles: " << spec.handles.size() << " with " << count_text(body.handled, "vertex")
        << "\n";
  for (std::size_t i = 0; i < body.loaded.size(); ++i)
    out << "  load: " << (spec.tractions[i].is_pressure() ? "pressure" : "traction") << " on "
        << count_text(body.loaded[i], "triangle") << "\n";
}

void print_obstacle(std::ostream& out, const PlannedObstacle& obstacle) {
  out << "obstacle " << in_quotes(obstacle.spec->name) << ": ";
  const auto* mesh = std::get_if<MeshObstacle>(&obstacle.spec->shape);
  if (!mesh) {
    const auto& plane = std::get<PlaneObstacle>(obstacle.spec->shape);
    out << "plane through " << to_text(plane.point) << " m with normal " << to_text(plane.normal)
        << "\n";
    return;
  }
  const std::size_t solid = obstacle.surface->solid.triangles.size();
  const std::size_t sheet = obstacle.surface->sheet_triangles();
  if (solid > 0) out << "solid of " << count_text(solid, "triangle");
  if (solid > 0 && sheet > 0) out << ", ";
  if (sheet > 0) out << "sheet of " << count_text(sheet, "triangle") << " that holds on both sides";
  std::vector<Vec3> points = obstacle.surface->solid.vertices;
  const std::vector<Vec3>& more = obstacle.surface->sheet.layers.vertices;
  points.insert(points.end(), more.begin(), more.end());
  out << "\n  placed at        " << box_text(bounding_box(placed_at(*mesh, points, 0))) << " m\n";
}

}  // namespace

std::unique_ptr<Plan> make_plan(const Options& options, Scene scene, ArchiveSource& source) {
  auto plan = std::make_unique<Plan>();
  plan->scene = std::move(scene);
  apply_options(options, *plan);
  std::vector<const BodyGeometry*> geometries;
  for (const BodySpec& body : plan->scene.bodies) {
    plan->bodies.push_back(plan_body(plan->scene, body, source));
    geometries.push_back(&plan->bodies.back().archive->geometry());
  }
  std::vector<const Discretisation*> deformable;
  for (const PlannedBody& body : plan->bodies)
    deformable.push_back(
        body.archive->kind() == ModelKind::rigid ? nullptr : &body.archive->discretisation());
  const std::vector<Scheme> schemes = body_schemes(plan->scene, deformable);
  place_bodies(plan->scene, geometries, source);
  JointPlan joints = plan_joints(plan->scene, geometries);
  for (const Joint& joint : joints.joints)
    if (joint.prescribed)
      ++(joint.handle ? plan->bodies[joint.a.body].handled : plan->bodies[joint.a.body].fixed);
  plan->welds = std::move(joints.welds);
  if (plan->scene.contact.enabled) plan_obstacles(*plan, source);
  if (plan->scene.initial_state) check_initial_state(*plan, schemes);
  plan_render_meshes(*plan);
  plan->memory = memory_of(plan->bodies, plan->scene.contact.enabled);
  add_warnings(*plan);
  warn_of_fast_obstacles(*plan);
  describe_welds(*plan);
  plan->twists = find_twists(plan->scene, static_cast<double>(plan->steps) * plan->scene.time_step);
  for (const Twist& twist : plan->twists) plan->warnings.push_back(twist_text(plan->scene, twist));
  return plan;
}

std::vector<std::string> warnings_of_start(const Simulation& simulation) {
  std::vector<std::string> warnings;
  for (const CollisionScene::Overlap& o : simulation.overlaps())
    warnings.push_back(in_quotes(o.a) + " and " + in_quotes(o.b) + " overlap at the start, by " +
                       rounded_text(o.depth, 3) + " m; move them apart");
  return warnings;
}

std::vector<std::string> warnings_of_scene(const Scene& scene) {
  if (scene.obstacles.empty() || scene.contact.enabled) return {};
  return {where(scene.obstacles[0].location) +
          ": obstacles touch nothing in a scene without contact; add \"contact\": {} to it"};
}

void print_place(std::ostream& out, const BodySpec& body, const BodyGeometry& geometry) {
  const std::vector<Vec3>& vertices = geometry.input.vertices;
  std::vector<Vec3> placed;
  for (const Vec3& x : vertices) placed.emplace_back(body.position + body.rotation.matrix() * x);
  out << "  mesh coordinates " << box_text(bounding_box(vertices)) << " m\n"
      << "  placed at        " << box_text(bounding_box(placed)) << " m\n";
}

std::string Plan::impossible(double time) const {
  for (const Twist& twist : twists)
    if (time >= twist.since) return short_twist_text(scene, twist);
  return "";
}

void check_memory(const Plan& plan) {
  const auto available = static_cast<double>(physical_memory());
  if (plan.memory <= available) return;
  throw Error(ErrorCode::resources, "the scene needs about " + bytes_text(plan.memory) +
                                        " of memory, the machine has " + bytes_text(available));
}

void print_plan(std::ostream& out, const Plan& plan) {
  const Scene& scene = plan.scene;
  std::size_t vertices = 0;
  std::set<const Archive*> archives;
  for (const PlannedBody& body : plan.bodies) {
    vertices += body.archive->geometry().input.vertices.size();
    archives.insert(body.archive);
  }
  out << "bodies:  " << plan.bodies.size() << " from " << count_text(archives.size(), "archive")
      << ", " << count_text(vertices, "vertex") << "\n";
  out << "memory:  about " << bytes_text(plan.memory) << "\n";
  out << "time:    " << count_text(static_cast<std::size_t>(plan.steps), "step") << " of "
      << to_text(scene.time_step) << " s\n";
  out << "threads: " << thread_count() << "\n";
  out << "output:  " << count_text(static_cast<std::size_t>(plan.frames()), "frame") << " as";
  for (const OutputFormat* format : scene.output.formats)
    out << (format == scene.output.formats.front() ? " " : ", ") << format->name;
  bool first = true;
  for (OutputField field : scene.output.fields) {
    if (field == OutputField::positions) continue;
    out << (first ? ", with " : ", ") << choice_name(field);
    first = false;
  }
  out << "\n";
  if (scene.contact.enabled)
    out << "contact: " << count_text(scene.obstacles.size(), "obstacle")
        << (scene.contact.self ? ", and of bodies with themselves" : "") << "\n";
  if (!scene.joints.empty()) out << "joints:  " << scene.joints.size() << "\n";
  for (const std::string& note : plan.notes) out << "  " << note << "\n";
  for (const PlannedBody& body : plan.bodies) print_body(out, body, scene.gravity);
  for (const PlannedObstacle& obstacle : plan.obstacles) print_obstacle(out, obstacle);
}

}  // namespace bem
