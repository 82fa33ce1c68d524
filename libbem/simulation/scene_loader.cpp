#include "simulation/scene_loader.hpp"

#include "base/error.hpp"
#include "mesh/describe.hpp"
#include "scene/location.hpp"
#include "simulation/initial_state.hpp"
#include "simulation/placement.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace bem {
namespace {

void check_time_step(const Scene& scene, const BodySpec& body, double dt) {
  if (std::abs(dt - scene.time_step) <= 1e-9 * dt) return;
  throw Error(ErrorCode::archive,
              where(body.archive.location) + ": the archive " + in_quotes(body.archive.written) +
                  " was made for the time step " + to_text(dt) + " s, the scene has " +
                  to_text(scene.time_step) + " s (" + where(scene.time_step_location) +
                  "); make the archive again with --dt " + to_text(scene.time_step) +
                  ", or change the scene");
}

void check_correction(const BodySpec& body, ModelKind kind, const Scheme& scheme) {
  if (body.correction == Correction::projection) return;
  const bool dynamic = kind == ModelKind::dynamic;
  if (dynamic && scheme.is_multistep()) return;
  throw Error(ErrorCode::archive,
              where(body.archive.location) + ": the correction \"least_squares\" of the body " +
                  in_quotes(body.name) +
                  " needs an archive of a dynamic body with the scheme "
                  "bdf1, bdf2 or theta:T, but " +
                  in_quotes(body.archive.written) +
                  (dynamic ? " has the scheme " + scheme.name() : " is of another model") +
                  "; make it again, or use the correction \"projection\"");
}

std::size_t bytes_of(const BodyModel& m) {
  std::size_t bytes = m.h ? m.h->bytes() : 0;
  for (const auto* families : {&m.inverse, &m.initial_h})
    for (const auto& family : *families) bytes += family->bytes();
  return bytes;
}

/// A rigid body moves by any scheme; it takes that of the bodies around it.
std::shared_ptr<const BodyModel> rigid_with_scheme(const BodyModel& model, const Scheme& scheme) {
  auto out = std::make_shared<BodyModel>();
  out->kind = ModelKind::rigid;
  out->geometry = model.geometry;
  out->discretisation = model.discretisation;
  out->discretisation.scheme = scheme;
  return out;
}

/// The steps of load_scene().
class SceneLoader {
 public:
  SceneLoader(Scene& scene, ModelSource& source, const InitialState* initial)
      : scene_(scene), source_(source), initial_(initial) {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      by_archive_[scene.bodies[b].archive.resolved].push_back(static_cast<int>(b));
  }

  LoadedScene run() {
    load_models();
    const std::vector<Scheme> schemes = body_schemes(scene_, deformable());
    if (initial_) initial_->check(starting_bodies(schemes));
    for (const auto& [path, users] : by_archive_) {
      SharedModel& shared = models_[path];
      if (shared.model->kind == ModelKind::rigid)
        shared.model = rigid_with_scheme(*shared.model, schemes[users[0]]);
      else
        load_shared_parts(users, shared);
    }
    make_bodies();
    return std::move(out_);
  }

 private:
  using Users = std::vector<int>;  ///< bodies of the same archive

  bool any_of(const Users& users, const std::function<bool(int)>& f) const {
    return std::any_of(users.begin(), users.end(), f);
  }
  void load_models();
  std::vector<const Discretisation*> deformable() const;
  void load_shared_parts(const Users& users, SharedModel& shared);
  std::vector<int> touched_nodes(const Users& users, const BodyModel& model) const;
  std::vector<StartingBody> starting_bodies(const std::vector<Scheme>& schemes);
  void make_bodies();

  Scene& scene_;
  ModelSource& source_;
  const InitialState* initial_;
  std::map<std::string, Users> by_archive_;
  std::map<std::string, SharedModel> models_;
  LoadedScene out_;
};

/// The models, and the joints between them.
void SceneLoader::load_models() {
  std::vector<const BodyGeometry*> geometries(scene_.bodies.size());
  for (const auto& [path, users] : by_archive_) {
    SharedModel& shared = models_[path];
    shared.model = source_.model(scene_.bodies[users[0]].archive);
    ++out_.archives;
    for (int b : users) {
      geometries[b] = &shared.model->geometry;
      check_archive(scene_, scene_.bodies[b], shared.model->kind, shared.model->discretisation);
    }
  }
  for (const BodySpec& body : scene_.bodies) out_.digests.push_back(source_.digest(body.archive));
  place_bodies(scene_, geometries, source_);
  out_.plan = plan_joints(scene_, geometries);
}

/// By body; null for rigid ones.
std::vector<const Discretisation*> SceneLoader::deformable() const {
  std::vector<const Discretisation*> out;
  for (const BodySpec& body : scene_.bodies) {
    const BodyModel& model = *models_.at(body.archive.resolved).model;
    out.push_back(model.kind == ModelKind::rigid ? nullptr : &model.discretisation);
  }
  return out;
}

std::vector<StartingBody> SceneLoader::starting_bodies(const std::vector<Scheme>& schemes) {
  std::vector<StartingBody> out;
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    const BodyModel& model = *models_[scene_.bodies[b].archive.resolved].model;
    out.push_back({&scene_.bodies[b], out_.digests[b], &model.geometry, model.kind,
                   schemes[b].name(), scene_.time_step});
  }
  return out;
}

/// What deformable bodies of one archive share, as far as one of them needs it.
void SceneLoader::load_shared_parts(const Users& users, SharedModel& shared) {
  const BodyModel& model = *shared.model;
  out_.sharing.push_back(users);
  shared.system = std::make_shared<ElasticSystem>(model);
  out_.matrix_bytes += bytes_of(model);
  if (any_of(users,
             [&](int b) { return scene_.bodies[b].correction == Correction::least_squares; }))
    shared.correction = std::make_shared<LeastSquaresCorrection>(*shared.system);
  if (model.has_centrifugal() &&
      any_of(users, [&](int b) { return scene_.bodies[b].has_centrifugal(); }))
    shared.centrifugal = std::make_shared<InputColumns>(
        shared.system->make_columns(model.centrifugal, model.initial_centrifugal));
  const std::vector<int> nodes = touched_nodes(users, model);
  if (!nodes.empty()) {
    shared.tractions = std::make_shared<NodalTractions>(
        *shared.system, source_.tractions(scene_.bodies[users[0]].archive, nodes));
    out_.matrix_bytes += shared.tractions->bytes();
  }
  if (any_of(users, [&](int b) {
        return !scene_.bodies[b].tractions.empty() || has_corner_loads(out_.plan.nodes[b]);
      }))
    shared.assembler =
        make_load_assembler(model.geometry.nodes, model.geometry.extent, model.discretisation);
}

/// Nodes that joints or contacts may act on, or have acted on, of bodies that share a model.
std::vector<int> SceneLoader::touched_nodes(const Users& users, const BodyModel& model) const {
  std::vector<char> touched(model.nodes(), 0), available(model.nodes(), model.loads == Loads::all);
  for (int node : model.loaded_nodes) available[node] = 1;
  if (scene_.contact.enabled) touched = available;
  for (int b : users)
    for (const JointNode& n : out_.plan.nodes[b]) {
      if (!available[n.node])
        throw Error(ErrorCode::archive,
                    where(scene_.bodies[b].archive.location) + ": the archive " +
                        in_quotes(scene_.bodies[b].archive.written) +
                        " was made without loads on a vertex of the body " +
                        in_quotes(scene_.bodies[b].name) +
                        " that is fixed, moved or joined; make it again with --loads all");
      touched[n.node] = 1;
    }
  if (initial_)
    for (int b : users)
      for (int node : initial_->touched(b)) touched[node] = available[node];
  std::vector<int> nodes;
  for (std::size_t i = 0; i < touched.size(); ++i)
    if (touched[i]) nodes.push_back(static_cast<int>(i));
  return nodes;
}

void SceneLoader::make_bodies() {
  out_.bodies.reserve(scene_.bodies.size());
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    const SharedModel& shared = models_[scene_.bodies[b].archive.resolved];
    const std::vector<JointNode>& nodes = out_.plan.nodes[b];
    std::shared_ptr<const CornerLoads> corners;
    if (shared.assembler) corners = make_corner_loads(*shared.system, *shared.assembler, nodes);
    out_.bodies.emplace_back(scene_.bodies[b], shared, scene_.time_step, scene_.gravity, nodes,
                             std::move(corners));
  }
}

}  // namespace

const ObstacleSurface& ModelSource::obstacle(const MeshObstacle& obstacle) {
  const FilePath& mesh = obstacle.mesh;
  const Vec3& scale = obstacle.scale;
  const std::pair key(mesh.resolved, std::array<double, 3>{scale[0], scale[1], scale[2]});
  const auto known = obstacles_.find(key);
  if (known != obstacles_.end()) return known->second;
  return obstacles_
      .emplace(key, at_place(mesh.location,
                             [&] {
                               return make_obstacle_surface(scaled(obstacle_mesh(mesh), scale),
                                                            mesh.resolved);
                             }))
      .first->second;
}

void check_archive(const Scene& scene, const BodySpec& body, ModelKind kind,
                   const Discretisation& discretisation) {
  if (kind == ModelKind::dynamic) check_time_step(scene, body, discretisation.dt);
  check_correction(body, kind, discretisation.scheme);
}

std::vector<Scheme> body_schemes(const Scene& scene,
                                 const std::vector<const Discretisation*>& deformable) {
  Scheme common = Scheme::radau2();
  for (auto d = deformable.rbegin(); d != deformable.rend(); ++d)
    if (*d) common = (*d)->scheme;
  std::vector<Scheme> schemes;
  for (const Discretisation* d : deformable) schemes.push_back(d ? d->scheme : common);
  for (const JointSpec& joint : scene.joints) {
    if (!joint.b) continue;
    const std::size_t a = joint.a.body, b = joint.b->body;
    if (schemes[a].name() == schemes[b].name()) continue;
    throw Error(ErrorCode::archive,
                where(joint.location) + ": the joint connects " + in_quotes(scene.bodies[a].name) +
                    ", which moves by " + schemes[a].name() + ", with " +
                    in_quotes(scene.bodies[b].name) + ", which moves by " + schemes[b].name() +
                    "; make their archives with the same --scheme");
  }
  return schemes;
}

LoadedScene load_scene(Scene& scene, ModelSource& source, const InitialState* initial) {
  return SceneLoader(scene, source, initial).run();
}

}  // namespace bem
