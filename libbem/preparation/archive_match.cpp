#include "preparation/archive_match.hpp"

#include "base/error.hpp"
#include "mesh/describe.hpp"

#include <filesystem>

namespace bem {
namespace {

std::string other(const char* what, const std::string& found, const std::string& wanted) {
  return std::string("has another ") + what + ": " + found + " instead of " + wanted;
}

std::string other(const char* what, double found, double wanted) {
  return found == wanted ? "" : other(what, to_text(found), to_text(wanted));
}

std::string difference_of_meshes(const TriangleMesh& found, const TriangleMesh& wanted) {
  const auto counts = [](const TriangleMesh& mesh) {
    return count_text(mesh.vertices.size(), "vertex") + " and " +
           count_text(mesh.triangles.size(), "triangle");
  };
  if (found.vertices.size() != wanted.vertices.size() ||
      found.triangles.size() != wanted.triangles.size())
    return other("mesh", counts(found), counts(wanted));
  if (found.triangles != wanted.triangles) return "has another mesh, with other triangles";
  for (std::size_t v = 0; v < found.vertices.size(); ++v)
    if (found.vertices[v] != wanted.vertices[v])
      return other(("mesh, whose vertex " + std::to_string(v) + " is elsewhere").c_str(),
                   to_text(found.vertices[v]), to_text(wanted.vertices[v]));
  return "";
}

std::string difference_of_loads(const Archive& archive, const PrecomputeOptions& wanted) {
  if (archive.loads() != wanted.loads)
    return other("set of loaded vertices", choice_name(archive.loads()), choice_name(wanted.loads));
  return archive.loaded_nodes() == wanted.loaded_nodes ? "" : "has other loaded vertices";
}

}  // namespace

bool is_repaired(const Archive& archive) {
  return archive.provenance().options.find(" --repair ") != std::string::npos;
}

std::string difference_from_mesh(const Archive& archive, TriangleMesh mesh, double scale) {
  for (Vec3& v : mesh.vertices) v *= scale;
  return difference_of_meshes(archive.geometry().input, mesh);
}

std::string difference_from_material(const Archive& archive, const Material& material) {
  const Material& found = archive.discretisation().material;
  std::string text = other("density", found.density, material.density);
  if (archive.kind() == ModelKind::rigid) return text;
  if (text.empty()) text = other("shear modulus", found.shear_modulus, material.shear_modulus);
  if (text.empty()) text = other("Poisson ratio", found.poisson_ratio, material.poisson_ratio);
  return text;
}

std::string difference_from_plan(const Archive& archive, const BodyPlan& plan,
                                 const std::string& program) {
  const Discretisation &found = archive.discretisation(), &wanted = plan.options.discretisation;
  const Provenance& made = archive.provenance();
  if (made.program != program) return other("origin", made.program, program);
  std::string text = difference_of_meshes(archive.geometry().input, plan.geometry.input);
  if (text.empty()) text = difference_from_material(archive, wanted.material);
  const std::string options = plan.settings.canonical_text() + plan.repair;
  if (text.empty() && made.options != options)
    text = other("set of options", made.options, options);
  if (!text.empty() || archive.kind() == ModelKind::rigid) return text;
  text = other("time step", found.dt, wanted.dt);
  if (text.empty()) text = other("history", found.history_length, wanted.history_length);
  return text.empty() ? difference_of_loads(archive, plan.options) : text;
}

bool is_up_to_date(const std::string& path, const BodyPlan& plan, const std::string& program,
                   SettingStyle style, bool replaces_archives) {
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown)) return false;
  const auto keep = [&](const std::string& why) {
    return Error(ErrorCode::usage, path + ": exists already and " + why + "; use " +
                                       setting_name(style, "force") + " to overwrite it");
  };
  std::string difference;
  try {
    difference = difference_from_plan(Archive(path), plan, program);
  } catch (const Error& e) {
    if (e.code() != ErrorCode::archive) throw;
    throw keep("is no complete archive");
  }
  if (!difference.empty() && !replaces_archives) throw keep(difference);
  return difference.empty();
}

}  // namespace bem
