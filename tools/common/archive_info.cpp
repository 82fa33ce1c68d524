#include "common/archive_info.hpp"

#include "archive/archive_layout.hpp"
#include "assembly/mesh_coarseness.hpp"
#include "mesh/bounding_box.hpp"

#include <nlohmann/json.hpp>

namespace bem {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Json material_json(const Material& m) {
  Json json = {{"name", m.name},
               {"density", m.density},
               {"shear_modulus", m.shear_modulus},
               {"poisson_ratio", m.poisson_ratio}};
  if (m.time_step) json["time_step"] = *m.time_step;
  return json;
}

void add_codec(Json& json, const Codec& codec) {
  json["codec"] = codec.name();
  if (codec.is_lossless()) json["precision"] = choice_name(*codec.precision());
}

Json body_json(const BodyGeometry& g, ModelKind kind) {
  const Vec3& c = g.mass.centre;
  const BoundingBox box = bounding_box(g.input.vertices);
  Json json = {{"nodes", g.nodes.vertices.size()},
               {"triangles", g.nodes.triangles.size()},
               {"volume", g.mass.volume},
               {"mass", g.mass.mass},
               {"centre_of_mass", {c[0], c[1], c[2]}},
               {"bounding_box",
                {{"min", {box.min[0], box.min[1], box.min[2]}},
                 {"max", {box.max[0], box.max[1], box.max[2]}}}},
               {"extent", g.extent}};
  if (kind != ModelKind::rigid) json["mesh_coarseness"] = mesh_coarseness(g.nodes);
  if (g.corner_angle_deg) json["corner_angle_deg"] = *g.corner_angle_deg;
  return json;
}

Json scheme_json(const Discretisation& d, double window) {
  Json json = {{"name", d.scheme.name()}, {"stages", d.scheme.stages()}};
  if (d.history_length > 0) json["dt"] = d.dt;
  json.update({{"history_length", d.history_length},
               {"window", window},
               {"quadrature_tolerance", d.quadrature_tolerance}});
  json["discretisation"] = choice_name(d.method);
  if (d.damping.time > 0) json["damping_time"] = d.damping.time;
  return json;
}

Json report_json(const ModelReport& r) {
  Json json = {{"lam", r.lam},
               {"row_sum_residual", r.row_sum_residual},
               {"rotation_residual", r.rotation_residual},
               {"condition", r.condition}};
  if (r.growth > 0) json["growth"] = r.growth;
  json["codec_errors"] = {{"h", r.codec_errors.h},
                          {"g", r.codec_errors.g},
                          {"inverse", r.codec_errors.inverse},
                          {"traction_response", r.codec_errors.traction_response},
                          {"stiffness", r.codec_errors.stiffness},
                          {"initial_h", r.codec_errors.initial_h},
                          {"initial_g", r.codec_errors.initial_g}};
  return json;
}

Json info_json(const Archive& archive) {
  const Provenance& p = archive.provenance();
  Json json = {{"format_version", archive.user_block().version},
               {"bytes", archive.user_block().payload + kUserBlock},
               {"digest", archive.user_block().digest},
               {"model", choice_name(archive.kind())},
               {"mesh",
                {{"vertices", archive.geometry().input.vertices.size()},
                 {"faces", archive.geometry().input.triangles.size()}}},
               {"body", body_json(archive.geometry(), archive.kind())},
               {"material", material_json(archive.discretisation().material)},
               {"provenance",
                {{"program", p.program},
                 {"mesh_file", p.mesh_file},
                 {"material_file", p.material_file},
                 {"mesh_scale", p.mesh_scale},
                 {"options", p.options}}}};
  if (archive.kind() == ModelKind::rigid) return json;
  add_codec(json, archive.codec());
  json["scheme"] = scheme_json(archive.discretisation(), archive.window());
  json["matrices"] = {{"unknowns", archive.unknowns()},
                      {"count", archive.matrix_paths().size()},
                      {"inverse", choice_name(archive.inverse_kind())},
                      {"loads", choice_name(archive.loads())}};
  if (archive.has_energies()) json["matrices"]["energies"] = true;
  if (archive.loads() == Loads::some)
    json["matrices"]["loaded_nodes"] = archive.loaded_nodes().size();
  json["report"] = report_json(archive.report());
  return json;
}

}  // namespace bem
