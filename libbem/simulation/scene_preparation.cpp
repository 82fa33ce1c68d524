#include "simulation/scene_preparation.hpp"

#include "archive/archive_writer.hpp"
#include "base/error.hpp"
#include "files/digest.hpp"
#include "mesh/describe.hpp"
#include "mesh/mesh_io.hpp"
#include "mesh/surface.hpp"
#include "preparation/archive_match.hpp"
#include "preparation/time_step.hpp"
#include "scene/selection.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace bem {
namespace {

constexpr SettingStyle kStyle = SettingStyle::key;

template <class T>
std::string digest_of_items(const std::vector<T>& items) {
  return digest_of({reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T)});
}

/// A mesh as it is in its file, and a digest of it.
struct MeshInput {
  TriangleMesh mesh;
  std::string digest;
};

MeshInput read_input(const std::string& path) {
  MeshInput input{read_mesh(path), ""};
  input.digest = digest_of_items(input.mesh.vertices) + " " + digest_of_items(input.mesh.triangles);
  return input;
}

void refuse_numbers(const BodySpec& body) {
  if (const Selection* numbers = selection_by_numbers(body))
    throw error_at(numbers->location,
                   "the mesh was repaired or remeshed, so that its vertices and triangles, and "
                   "groups of them, have no numbers; select by a box, sphere or plane");
}

/// The steps of prepare_scene().
class ScenePreparation {
 public:
  ScenePreparation(Scene& scene, ArchiveSource& source, const ArchiveCache& cache,
                   MissingArchives missing, const PreparationOptions& options)
      : scene_(scene), source_(source), cache_(cache), missing_(missing), options_(options) {}

  /// Returns how many archives are missing.
  std::size_t run() {
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b) inputs_.push_back(inputs_of(b));
    if (scene_.time_step == 0) choose_time_step();
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
      BodySpec& body = scene_.bodies[b];
      if (!body.source) continue;
      if (body.archive.resolved.empty())
        provide(body, inputs_[b]);
      else
        compare(body);
    }
    if (!listed_.empty() && missing_ == MissingArchives::list && options_.listed) list();
    return listed_.size();
  }

 private:
  const MeshInput& input_of(const BodySource& source);
  const SimulatedMesh& simulated(const BodySource& source, const BodyInputs& inputs);
  BodyInputs inputs_of(std::size_t b) const;
  void choose_loads(std::size_t b, BodyInputs& inputs) const;
  bool is_joined(std::size_t b) const;
  void choose_time_step();
  std::string text_of_all(const BodySource& source, const BodyInputs& inputs);
  void provide(BodySpec& body, BodyInputs& inputs);
  void open(const BodySpec& body, const BodyInputs& inputs);
  BodyPlan plan(const BodySpec& body, const BodyInputs& inputs);
  void compute(const BodySpec& body, const BodyInputs& inputs);
  void compare(const BodySpec& body);
  void list();

  Scene& scene_;
  ArchiveSource& source_;
  const ArchiveCache& cache_;
  MissingArchives missing_;
  const PreparationOptions& options_;
  std::set<std::string> listed_;                    ///< paths of archives that are missing
  std::map<std::string, BodyGeometry> planned_;     ///< of these, by path
  std::vector<BodyInputs> inputs_;                  ///< by body; empty ones without a source
  std::map<std::string, MeshInput> meshes_;         ///< by path
  std::map<std::string, SimulatedMesh> simulated_;  ///< by path and what is done to it
};

/// Read once.
const MeshInput& ScenePreparation::input_of(const BodySource& source) {
  const std::string& path = source.mesh.resolved;
  const auto known = meshes_.find(path);
  if (known != meshes_.end()) return known->second;
  return meshes_.emplace(path, at_place(source.mesh.location, [&] { return read_input(path); }))
      .first->second;
}

/// What is made of it, which is done once.
const SimulatedMesh& ScenePreparation::simulated(const BodySource& source,
                                                 const BodyInputs& inputs) {
  const std::string key = source.mesh.resolved + inputs.settings.repair_text(inputs.repair);
  const auto known = simulated_.find(key);
  if (known != simulated_.end()) return known->second;
  return simulated_.emplace(key, simulated_mesh(input_of(source).mesh, inputs, kStyle))
      .first->second;
}

BodyInputs ScenePreparation::inputs_of(std::size_t b) const {
  const BodySpec& body = scene_.bodies[b];
  if (!body.source) return {};
  const BodySource& source = *body.source;
  BodyInputs inputs;
  inputs.mesh = source.mesh.resolved;
  inputs.mesh_scale = source.mesh_scale;
  inputs.material = source.material;
  inputs.material_name = source.material_path.written;
  inputs.settings = source.settings;
  inputs.repair = RepairMode::automatic;
  choose_loads(b, inputs);
  return inputs;
}

/// Where nothing but held vertices can act on a body, only these get loads.
void ScenePreparation::choose_loads(std::size_t b, BodyInputs& inputs) const {
  const BodySpec& body = scene_.bodies[b];
  if (!inputs.settings.loads.empty()) return;
  if (scene_.contact.enabled || is_joined(b)) return;
  if (body.fixed.empty() && body.handles.empty()) inputs.settings.loads = "none";
  if (!inputs.settings.codec_options().codec->is_sampled()) return;
  inputs.loaded = body.fixed;
  for (const HandleSpec& handle : body.handles) inputs.loaded.push_back(handle.select);
}

bool ScenePreparation::is_joined(std::size_t b) const {
  return std::any_of(scene_.joints.begin(), scene_.joints.end(), [&](const JointSpec& joint) {
    return joint.a.body == b || (joint.b && joint.b->body == b);
  });
}

void ScenePreparation::choose_time_step() {
  std::vector<double> times;
  std::set<std::string> seen;
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    const BodySpec& body = scene_.bodies[b];
    if (!body.archive.resolved.empty()) {
      const Archive& archive = source_.open(body.archive);
      if (archive.kind() != ModelKind::dynamic) continue;
      scene_.time_step = archive.discretisation().dt;
      options_.note("the time step is that of " + body.archive.written + ": " +
                    to_text(scene_.time_step) + " s");
      return;
    }
    if (inputs_[b].settings.model == ModelKind::rigid) continue;
    if (!seen.insert(text_of_all(*body.source, inputs_[b])).second) continue;
    times.push_back(at_place_of_input(body.source->mesh.location, [&] {
      return crossing_time(simulated(*body.source, inputs_[b]), inputs_[b]);
    }));
  }
  const AutomaticTimeStep step = automatic_time_step(times, options_.frame_interval);
  scene_.time_step = step.seconds;
  for (BodyInputs& inputs : inputs_) inputs.automatic_time_step = true;
  options_.note("the time step is " + to_text(step.seconds) + " s" + step.reason);
}

/// Everything that the bytes of an archive depend on.
std::string ScenePreparation::text_of_all(const BodySource& source, const BodyInputs& inputs) {
  const Material& m = inputs.material;
  const auto name = [](const std::string& path) {
    return std::filesystem::path(path).filename().string();
  };
  std::string text = options_.program + "\narchive " + std::to_string(kArchiveVersion) + "\nmesh " +
                     name(inputs.mesh) + " " + input_of(source).digest + " times " +
                     to_text(inputs.mesh_scale) + "\nmaterial " + name(inputs.material_name) + " " +
                     m.name + " " + to_text(m.density) + " " + to_text(m.shear_modulus) + " " +
                     to_text(m.poisson_ratio) + "\ntime step " + to_text(scene_.time_step) + "\n" +
                     inputs.settings.canonical_text();
  text += inputs.settings.repair_text(inputs.repair);
  if (inputs.settings.measure_growth) text += " --measure-growth";
  if (inputs.settings.has_load_file()) text += "\nloads " + file_digest(inputs.settings.loads);
  for (const Selection& selection : inputs.loaded) text += "\nloads on " + to_text(selection);
  return text;
}

void ScenePreparation::provide(BodySpec& body, BodyInputs& inputs) {
  inputs.settings.time_step = scene_.time_step;
  const std::string path = cache_.path_of(inputs.mesh, text_of_all(*body.source, inputs));
  body.archive.resolved = path;
  if (missing_ == MissingArchives::count) {
    if (!cache_.has(path)) listed_.insert(path);
    return;
  }
  if (missing_ == MissingArchives::list && !cache_.has(path)) {
    if (listed_.insert(path).second)
      at_place_of_input(body.source->mesh.location,
                        [&] { planned_.emplace(path, plan(body, inputs).geometry); });
    return;
  }
  at_place_of_input(body.source->mesh.location, [&] {
    cache_.provide(
        path, [&] { compute(body, inputs); },
        [&] { options_.note(path + ": another process computes this archive; waiting for it"); });
  });
  open(body, inputs);
}

/// An archive in the cache that is damaged, or that was removed a moment ago, is made again.
void ScenePreparation::open(const BodySpec& body, const BodyInputs& inputs) {
  try {
    source_.open(body.archive);
  } catch (const Error& e) {
    if (e.code() != ErrorCode::archive) throw;
    options_.warn(std::string(e.what()) + "; it is computed again");
    at_place_of_input(body.source->mesh.location, [&] { compute(body, inputs); });
    source_.open(body.archive);
  }
  if (is_repaired(source_.open(body.archive))) refuse_numbers(body);
}

/// Says what has to be computed.
BodyPlan ScenePreparation::plan(const BodySpec& body, const BodyInputs& inputs) {
  const SimulatedMesh& mesh = simulated(*body.source, inputs);
  if (mesh.changed) refuse_numbers(body);
  BodyPlan plan = plan_body(mesh, inputs, kStyle);
  for (const std::string& note : plan.notes) options_.note(note);
  for (const std::string& warning : plan.warnings) options_.warn(warning);
  const bool compute = missing_ == MissingArchives::compute;
  options_.note(
      body.source->mesh.written +
      (compute ? ": computing the matrices of " : ": the matrices are not computed yet: ") +
      std::to_string(plan.geometry.nodes.vertices.size()) + " nodes, history of " +
      std::to_string(plan.options.discretisation.history_length) + " steps");
  return plan;
}

void ScenePreparation::compute(const BodySpec& body, const BodyInputs& inputs) {
  BodyPlan plan = this->plan(body, inputs);
  if (options_.memory > 0) check_memory(plan, options_.memory, kStyle);
  const Provenance provenance = provenance_of(inputs, plan, options_.program);
  const BodyModel model = precompute(std::move(plan.geometry), plan.options, options_.progress);
  write_archive(body.archive.resolved, model, provenance, true, options_.progress);
}

void ScenePreparation::list() {
  std::vector<const BodyGeometry*> geometries;
  for (const BodySpec& body : scene_.bodies) {
    const auto planned = planned_.find(body.archive.resolved);
    geometries.push_back(planned == planned_.end() ? &source_.open(body.archive).geometry()
                                                   : &planned->second);
  }
  options_.listed(geometries);
}

void ScenePreparation::compare(const BodySpec& body) {
  const BodySource& from = *body.source;
  const Archive& archive = source_.open(body.archive);
  std::string difference;
  if (!is_repaired(archive))
    difference = difference_from_mesh(archive, input_of(from).mesh, from.mesh_scale);
  if (difference.empty()) difference = difference_from_material(archive, from.material);
  if (!difference.empty())
    throw Error(ErrorCode::archive,
                where(body.archive.location) + ": the archive " + in_quotes(body.archive.written) +
                    " " + difference +
                    ", as the body names them beside it; make it again, or leave \"archive\" away");
}

}  // namespace

std::size_t prepare_scene(Scene& scene, ArchiveSource& source, const ArchiveCache& cache,
                          MissingArchives missing, const PreparationOptions& options) {
  return ScenePreparation(scene, source, cache, missing, options).run();
}

}  // namespace bem
