#include "archive/archive_reader.hpp"
#include "archive/archive_writer.hpp"
#include "arrays.hpp"
#include "base/error.hpp"
#include "base/nearest_name.hpp"
#include "bindings.hpp"
#include "common/archive_info.hpp"
#include "common/measure.hpp"
#include "common/version.hpp"
#include "mesh/mesh_io.hpp"
#include "model/memory_estimate.hpp"
#include "preparation/archive_match.hpp"
#include "scene/location.hpp"
#include "scene/material_json.hpp"
#include "scene/named_materials.hpp"
#include "unlocked.hpp"

#include <map>
#include <optional>

#include <nlohmann/json.hpp>
#include <pybind11/stl.h>

namespace bem::python {
namespace {

namespace py = pybind11;

constexpr SettingStyle kStyle = SettingStyle::key;

const Setting& setting_named(const std::string& key) {
  std::vector<std::string> names;
  for (const Setting& setting : precompute_settings()) {
    if (setting.key() == key) return setting;
    names.push_back(setting.key());
  }
  const std::string nearest = nearest_name(key, names);
  throw Error(ErrorCode::usage, "there is no setting " + in_quotes(key) +
                                    (nearest.empty() ? "; there are " + list_text(names)
                                                     : "; is " + in_quotes(nearest) + " meant?"));
}

/// By key and text, as scenes and command lines have them.
PrecomputeSettings settings_of(const std::map<std::string, std::string>& texts) {
  PrecomputeSettings settings;
  for (const auto& [key, text] : texts)
    setting_named(key).set(settings, setting_name(kStyle, key), text);
  check_settings(settings, kStyle);
  return settings;
}

/// What an archive is made of, but for its mesh.
struct Request {
  std::string output;
  bool force = false;
  BodyInputs inputs;
};

Request request_of(const std::string& mesh, double mesh_scale, const std::string& material,
                   bool is_json, const std::map<std::string, std::string>& settings,
                   const std::string& output, bool force) {
  if (!(std::isfinite(mesh_scale) && mesh_scale > 0))
    throw Error(ErrorCode::usage,
                "mesh_scale must be a positive number, not " + to_text(mesh_scale));
  Request request{output, force, {}};
  request.inputs.mesh = mesh;
  request.inputs.mesh_scale = mesh_scale;
  request.inputs.material =
      is_json ? parse_material("material", material) : find_material(material);
  request.inputs.material_name = is_json ? request.inputs.material.name : material;
  request.inputs.settings = settings_of(settings);
  return request;
}

void make_archive(const Request& request, const TriangleMesh& mesh, const Listener& listener) {
  BodyPlan plan = plan_body(simulated_mesh(mesh, request.inputs, kStyle), request.inputs, kStyle);
  for (const std::string& note : plan.notes) listener.note(note);
  for (const std::string& warning : plan.warnings) listener.warn(warning);
  if (!request.force && is_up_to_date(request.output, plan, version_text(), kStyle)) return;
  check_memory(plan, static_cast<double>(physical_memory()), kStyle);
  check_archive_target(
      request.output, true,
      archive_bytes(plan.geometry, plan.options, certain_bytes(plan.geometry, plan.options)));
  const Provenance provenance = provenance_of(request.inputs, plan, version_text());
  const BodyModel model = precompute(std::move(plan.geometry), plan.options, listener.progress);
  write_archive(request.output, model, provenance, request.force, listener.progress);
}

/// Without arrays, `name` is the path of the mesh.
void precompute_mesh(const std::string& name, const std::optional<std::pair<Doubles, Ints>>& arrays,
                     double mesh_scale, const std::string& material, bool is_json,
                     const std::map<std::string, std::string>& settings, const std::string& output,
                     bool force, const py::object& note, const py::object& warn,
                     const py::object& progress) {
  TriangleMesh mesh;
  if (arrays) mesh = {points_of(arrays->first), triangles_of(arrays->second)};
  const Listener listener = listener_of(note, warn, progress);
  const Interruptible work;
  const Request request = request_of(name, mesh_scale, material, is_json, settings, output, force);
  if (!arrays) mesh = read_mesh(name);
  make_archive(request, mesh, listener);
}

py::tuple read_arrays(const std::string& path) {
  TriangleMesh mesh;
  {
    const Interruptible work;
    mesh = read_mesh(path);
  }
  return py::make_tuple(array_of(mesh.vertices), array_of(mesh.triangles));
}

std::unique_ptr<Archive> open_archive(const std::string& path) {
  const Interruptible work;
  return std::make_unique<Archive>(path);
}

void verify(const Archive& archive, const py::object& progress) {
  const Listener listener = listener_of(py::none(), py::none(), progress);
  const Interruptible work;
  archive.check_matrices(listener.progress);
}

}  // namespace

void add_archives(py::module_& module) {
  module.def("precompute", precompute_mesh);
  module.def("read_mesh", read_arrays);
  module.def("settings", [] {
    py::dict out;
    for (const Setting& setting : precompute_settings()) out[py::str(setting.key())] = setting.help;
    return out;
  });
  module.def("materials", [] {
    std::vector<std::string> names;
    for (const NamedMaterial& material : named_materials()) names.emplace_back(material.name);
    return names;
  });
  py::class_<Archive>(module, "Archive")
      .def(py::init(&open_archive))
      .def("info", [](const Archive& archive) { return info_json(archive).dump(); })
      .def("verify", verify)
      .def("vertices", [](const Archive& a) { return array_of(a.geometry().input.vertices); })
      .def("faces", [](const Archive& a) { return array_of(a.geometry().input.triangles); });
}

}  // namespace bem::python
