#include "report.hpp"

#include "archive/archive_layout.hpp"
#include "assembly/mesh_coarseness.hpp"
#include "base/parallel.hpp"
#include "common/archive_info.hpp"
#include "common/cli.hpp"
#include "mesh/describe.hpp"

#include <filesystem>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace bem {
namespace {

using Json = nlohmann::ordered_json;

/// The shortest time steps with a history of some lengths: "n_max 4: 0.012 s, ...".
std::string time_steps_text(const Plan& plan) {
  constexpr double kSearch = 1.0005;  // from one time step to the next shorter one
  constexpr int kTargets[] = {4, 6, 8, 12, 20, 32};
  const Discretisation& d = plan.body.options.discretisation;
  std::ostringstream text;
  double lam = 0.1;
  for (int target : kTargets) {
    const auto length = [&](double l) {
      const double dt = plan.body.lam * d.dt / l;
      return default_history_length(d.scheme, l) + damped_history_length(l, d.damping.time / dt);
    };
    while (length(lam * kSearch) <= target) lam *= kSearch;
    if (length(lam) > target) continue;
    text << (text.str().empty() ? "" : ", ") << "n_max " << target << ": " << std::setprecision(3)
         << plan.body.lam * d.dt / lam << " s";
  }
  return text.str();
}

/// "name:   value" lines with aligned values.
class Table {
 public:
  explicit Table(std::ostream& out) : out_(out) {}

  template <class... Parts>
  void line(const std::string& name, const Parts&... parts) {
    std::ostringstream text;
    text << std::left << std::setw(16) << name + ":" << std::setprecision(6);
    (text << ... << parts);
    out_ << text.str() << "\n";
  }

 private:
  std::ostream& out_;
};

void print_body(Table& table, const BodyGeometry& g, const Material& m, ModelKind kind) {
  table.line("mesh", g.input.vertices.size(), " vertices, ", g.input.triangles.size(),
             " triangles, ", g.nodes.vertices.size(), " nodes");
  const BoundingBox box = bounding_box(g.input.vertices);
  table.line("mesh box", to_text(box.min), " to ", to_text(box.max), " m");
  table.line("body", "extent ", g.extent, " m, volume ", g.mass.volume, " m^3, mass ", g.mass.mass,
             " kg");
  if (kind != ModelKind::rigid)
    table.line("coarseness", "linear triangles leave out ", percent_text(mesh_coarseness(g.nodes)),
               " of uniform bending and twisting");
  if (g.corner_angle_deg)
    table.line("corners", "double nodes along edges sharper than ", *g.corner_angle_deg,
               " degrees");
  table.line("material", m.name, ": density ", m.density, " kg/m^3, shear modulus ",
             m.shear_modulus, " Pa, Poisson ratio ", m.poisson_ratio);
}

void print_scheme(Table& table, const Discretisation& d, double lam) {
  if (d.history_length == 0)
    table.line("time", "any time step, without history; the frame moves by ", d.scheme.name());
  else
    table.line("time", d.scheme.name(), ", dt ", d.dt, " s, history of ", d.history_length,
               " steps (a shear wave crosses the body in ", lam, " steps)");
}

void print_codec_errors(Table& table, const Archive& archive) {
  const ModelReport::CodecErrors& e = archive.report().codec_errors;
  const char* lags = archive.is_inertial() ? "Z " : "H ";
  std::ostringstream stiffness;
  if (archive.is_inertial()) stiffness << "D(0) " << e.stiffness << ", ";
  if (archive.is_iterative())
    table.line("codec errors", stiffness.str(), lags, e.h, ", G ", e.g, ", H_0 ", e.initial_h,
               ", G_0 ", e.initial_g);
  else
    table.line("codec errors", stiffness.str(), lags, e.h, ", G ", e.g, ", inverse ", e.inverse,
               ", traction response ", e.traction_response);
}

void print_storage(Table& table, const Archive& archive) {
  const char* inverse = archive.is_iterative() ? "none: steps solve with H_0" : "stored";
  switch (archive.loads()) {
    case Loads::all:
      table.line("inverse", inverse, "; loads on all nodes");
      break;
    case Loads::some:
      table.line("inverse", inverse, "; loads on ", archive.loaded_nodes().size(), " nodes");
      break;
    case Loads::none:
      table.line("inverse", inverse, "; no loads on single nodes, contacts or joints");
  }
}

void print_matrices(Table& table, const Archive& archive) {
  const Discretisation& d = archive.discretisation();
  const ModelReport& r = archive.report();
  print_scheme(table, d, r.lam);
  const bool dynamic = archive.kind() == ModelKind::dynamic;
  table.line("discretisation", choice_name(d.method));
  if (dynamic) table.line("window", archive.window());
  if (d.damping.time > 0)
    table.line("damping", "Kelvin-Voigt, retardation time ", d.damping.time, " s");
  table.line("matrices", archive.matrix_paths().size(), " of ", archive.unknowns(), " x ",
             archive.unknowns(), ", codec ", archive.codec().name(),
             archive.codec().is_lossless()
                 ? std::string(", ") + choice_name(*archive.codec().precision())
                 : "");
  print_storage(table, archive);
  if (archive.has_energies()) table.line("energies", "matrices of kinetic and elastic energy");
  table.line("quadrature", "tolerance ", d.quadrature_tolerance, ", row sums repaired by ",
             r.row_sum_residual, ", rotation residual ", r.rotation_residual);
  if (!archive.codec().is_lossless()) print_codec_errors(table, archive);
  if (dynamic && r.growth > 0)
    table.line("stability", "growth factor per step ", r.growth * archive.window(), " (", r.growth,
               " without window)");
  if (!archive.is_iterative()) table.line("condition", r.condition, " (lag 0)");
}

}  // namespace

void print_info(std::ostream& out, const Archive& archive) {
  Table table(out);
  const Provenance& p = archive.provenance();
  table.line("archive", archive.path(), ", ",
             bytes_text(static_cast<double>(archive.user_block().payload + kUserBlock)),
             ", format version ", archive.user_block().version);
  table.line("model", choice_name(archive.kind()));
  print_body(table, archive.geometry(), archive.discretisation().material, archive.kind());
  if (archive.kind() != ModelKind::rigid) print_matrices(table, archive);
  table.line("made by", p.program, " from ", p.mesh_file, " (times ", p.mesh_scale, ") and ",
             p.material_file);
  table.line("options", p.options);
  table.line("digest", archive.user_block().digest, " (checked)");
}

void print_plan(std::ostream& out, const Plan& plan, const TimeEstimate& time) {
  Table table(out);
  const Discretisation& d = plan.body.options.discretisation;
  print_body(table, plan.body.geometry, d.material, plan.body.options.kind);
  table.line("archive size", "about ", bytes_text(plan.archive_bytes));
  if (plan.body.options.kind == ModelKind::rigid) return;
  print_scheme(table, d, plan.body.lam);
  if (plan.body.options.kind == ModelKind::dynamic) {
    table.line("lam", plan.body.lam);
    table.line("n_max", d.history_length);
    table.line("time steps", time_steps_text(plan));
  }
  table.line("memory", "about ", bytes_text(plan.stored), " of matrices, ", bytes_text(plan.peak),
             " at most (the machine has ", bytes_text(static_cast<double>(physical_memory())), ")");
  table.line("time", "about ", seconds_text(time.total()), " on ", thread_count(),
             " threads (assembly and compression ", seconds_text(time.assembly), ", inversion ",
             seconds_text(time.inversion),
             time.growth > 0 ? ", growth factor " + seconds_text(time.growth) : "", ")");
}

Json stats_json(const BodyModel& model, const std::string& archive, const PhaseTimer& timer,
                const std::vector<std::string>& warnings) {
  Json phases = Json::array();
  for (const PhaseTimer::Phase& p : timer.phases())
    phases.push_back({{"name", p.name},
                      {"wall_seconds", p.wall_seconds},
                      {"cpu_seconds", p.cpu_seconds},
                      {"peak_memory_bytes", p.peak_memory}});
  Json json = {{"program", version_text()},
               {"archive", archive},
               {"archive_bytes", std::filesystem::file_size(archive)},
               {"model", choice_name(model.kind)},
               {"threads", thread_count()},
               {"wall_seconds", timer.total_wall_seconds()},
               {"peak_memory_bytes", peak_memory()},
               {"phases", phases},
               {"body", body_json(model.geometry, model.kind)},
               {"material", material_json(model.discretisation.material)},
               {"warnings", warnings}};
  if (model.kind == ModelKind::rigid) return json;
  add_codec(json, *model.codec);
  json["scheme"] = scheme_json(model.discretisation, model.window);
  json["report"] = report_json(model.report);
  return json;
}

}  // namespace bem
