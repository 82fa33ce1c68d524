#include "archive/archive_writer.hpp"

#include "archive/archive_contents.hpp"
#include "archive/archive_layout.hpp"
#include "archive/scheme_tables.hpp"
#include "archive/user_block.hpp"
#include "files/hdf5.hpp"
#include "files/pending_file.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>

namespace bem {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// What the file needs besides the matrices: objects of HDF5 and the mesh [bytes].
double overhead_bytes(const BodyGeometry& g, double datasets) {
  const auto vertices = static_cast<double>(g.input.vertices.size() + g.nodes.vertices.size());
  const auto triangles = static_cast<double>(g.input.triangles.size());
  const auto nodes = static_cast<double>(g.nodes.vertices.size());
  return 28 * vertices + 28 * triangles + 288 * nodes + 400 * datasets + 7000;
}

std::vector<const MatrixFamily*> large_families(const BodyModel& model) {
  std::vector<const MatrixFamily*> families;
  for (const auto* group :
       {&model.inverse, &model.traction_response, &model.initial_h, &model.initial_g})
    for (const auto& family : *group) families.push_back(family.get());
  for (const auto* family : {model.h.get(), model.g.get(), model.stiffness.get(),
                             model.energy_stiffness.get(), model.energy_mass.get()})
    if (family) families.push_back(family);
  return families;
}

/// Of the tables of compressed families.
double table_bytes(const BodyModel& model) {
  double bytes = 0;
  for (const MatrixFamily* family : large_families(model)) bytes += family->table_bytes();
  return bytes;
}

double matrix_bytes(const BodyModel& model) {
  double bytes = 0;
  for (const MatrixFamily* family : large_families(model))
    bytes += static_cast<double>(family->bytes());
  for (const auto* lags : {&model.body_force, &model.centrifugal})
    for (const auto& m : *lags) bytes += 8.0 * static_cast<double>(m.size());
  for (const auto* initial : {&model.initial_body_force, &model.initial_centrifugal})
    for (const auto& m : *initial) bytes += 16.0 * static_cast<double>(m.size());
  bytes += 8.0 * static_cast<double>(model.balance.size() + model.traction_balance.size());
  for (const auto& m : model.traction_moments) bytes += 16.0 * static_cast<double>(m.size());
  return bytes;
}

void write_points(Hdf5File& file, const std::string& path, const std::vector<Vec3>& points) {
  std::vector<double> data;
  data.reserve(3 * points.size());
  for (const Vec3& p : points) data.insert(data.end(), p.data(), p.data() + 3);
  file.write(path, data, {points.size(), 3});
  file.set_attribute(path, "unit", "m");
}

void write_triangles(Hdf5File& file, const std::string& path,
                     const std::vector<Triangle>& triangles) {
  std::vector<std::int32_t> data;
  data.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) data.insert(data.end(), t.begin(), t.end());
  file.write(path, data, {triangles.size(), 3});
}

void write_indices(Hdf5File& file, const std::string& path, const std::vector<int>& indices) {
  file.write(path, std::vector<std::int32_t>(indices.begin(), indices.end()), {indices.size()});
}

void write_small(Hdf5File& file, const std::string& path, const RowMajor& values) {
  file.write(path, values.data(),
             {static_cast<std::size_t>(values.rows()), static_cast<std::size_t>(values.cols())});
}

void write_geometry(Hdf5File& file, const BodyGeometry& g) {
  write_points(file, "/mesh/vertices", g.input.vertices);
  write_triangles(file, "/mesh/faces", g.input.triangles);
  write_points(file, "/body/nodes", g.nodes.vertices);
  write_triangles(file, "/body/triangles", g.nodes.triangles);
  write_indices(file, "/body/node_of_vertex", g.node_of_vertex);
  write_indices(file, "/body/triangle_order", g.triangle_order);
  file.write("/body/centre_of_mass", g.mass.centre.data(), {3});
  file.set_attribute("/body/centre_of_mass", "unit", "m");
  write_small(file, "/body/inertia", g.mass.inertia);
  file.set_attribute("/body/inertia", "unit", "kg m^2");
  file.set_attribute("/body", "volume", g.mass.volume);
  file.set_attribute("/body", "mass", g.mass.mass);
  file.set_attribute("/body", "extent", g.extent);
  if (g.corner_angle_deg) file.set_attribute("/body", "corner_angle_deg", *g.corner_angle_deg);
}

void write_material(Hdf5File& file, const Material& m) {
  file.create_group("/material");
  file.set_attribute("/material", "name", m.name);
  file.set_attribute("/material", "density", m.density);
  file.set_attribute("/material", "shear_modulus", m.shear_modulus);
  file.set_attribute("/material", "poisson_ratio", m.poisson_ratio);
  if (m.time_step) file.set_attribute("/material", "time_step", *m.time_step);
}

void write_scheme(Hdf5File& file, const BodyModel& model) {
  const Discretisation& d = model.discretisation;
  file.create_group("/scheme");
  file.set_attribute("/scheme", "name", d.scheme.name());
  file.set_attribute("/scheme", "stages", d.scheme.stages());
  if (model.kind == ModelKind::dynamic) file.set_attribute("/scheme", "dt", d.dt);
  file.set_attribute("/scheme", "history_length", d.history_length);
  file.set_attribute("/scheme", "window", model.window);
  file.set_attribute("/scheme", "quadrature_tolerance", d.quadrature_tolerance);
  if (d.is_galerkin()) file.set_attribute("/scheme", "discretisation", choice_name(d.method));
  if (d.damping.time > 0) file.set_attribute("/scheme", "damping_time", d.damping.time);
  for (const SchemeTable& table : scheme_tables(d.scheme)) {
    Hdf5Dims dims = {static_cast<std::size_t>(table.values.rows())};
    if (!table.is_vector) dims.push_back(static_cast<std::size_t>(table.values.cols()));
    file.write(table.path, table.values.data(), dims);
  }
}

void write_report(Hdf5File& file, const ModelReport& r) {
  file.create_group("/report");
  file.set_attribute("/report", "lam", r.lam);
  file.set_attribute("/report", "row_sum_residual", r.row_sum_residual);
  file.set_attribute("/report", "rotation_residual", r.rotation_residual);
  file.set_attribute("/report", "condition", r.condition);
  file.set_attribute("/report", "growth", r.growth);
  file.set_attribute("/report", "codec_error_h", r.codec_errors.h);
  file.set_attribute("/report", "codec_error_g", r.codec_errors.g);
  file.set_attribute("/report", "codec_error_inverse", r.codec_errors.inverse);
  file.set_attribute("/report", "codec_error_traction_response", r.codec_errors.traction_response);
  file.set_attribute("/report", "codec_error_initial_h", r.codec_errors.initial_h);
  file.set_attribute("/report", "codec_error_initial_g", r.codec_errors.initial_g);
  if (r.codec_errors.stiffness > 0)
    file.set_attribute("/report", "codec_error_stiffness", r.codec_errors.stiffness);
}

void write_provenance(Hdf5File& file, const Provenance& p) {
  file.create_group("/provenance");
  file.set_attribute("/provenance", "program", p.program);
  file.set_attribute("/provenance", "mesh_file", p.mesh_file);
  file.set_attribute("/provenance", "material_file", p.material_file);
  file.set_attribute("/provenance", "mesh_scale", p.mesh_scale);
  file.set_attribute("/provenance", "options", p.options);
}

/// Writes the large matrices and reports how much of them is written.
class MatrixWriter {
 public:
  MatrixWriter(Hdf5File& file, double total_bytes, const Progress& progress)
      : file_(file), total_(total_bytes), progress_(progress) {}

  void write(const FamilyPlace& place, const MatrixFamily& family) {
    family.write(file_, place, [this](std::size_t bytes) {
      written_ += static_cast<double>(bytes);
      if (progress_) progress_("writing", std::min(1.0, written_ / total_));
    });
  }

 private:
  Hdf5File& file_;
  double total_, written_ = 0;
  const Progress& progress_;
};

/// A small matrix of lag 0.
void write_parts(Hdf5File& file, const BodyModel& model, const char* name, std::size_t component,
                 const Eigen::MatrixXcd& matrix) {
  const bool paired = model.discretisation.scheme.initial_components()[component].paired;
  const auto paths = initial_paths(name, component, paired ? 2 : 1);
  write_small(file, paths[0], matrix.real());
  if (paired) write_small(file, paths[1], matrix.imag());
}

void write_body_force(Hdf5File& file, const BodyModel& model, const char* name,
                      const std::vector<Eigen::MatrixXd>& by_lag,
                      const std::vector<Eigen::MatrixXcd>& initial) {
  const std::size_t unknowns = 3 * model.nodes();
  const auto lags = static_cast<std::size_t>(model.discretisation.history_length);
  const auto components = static_cast<std::size_t>(model.components());
  const std::string path = lags_path(name) + "/lags";
  if (lags > 0) file.create_dataset(path, Hdf5Type::float64, {lags, components, unknowns, 6});
  for (std::size_t i = 0; i < by_lag.size(); ++i) {
    const RowMajor columns = by_lag[i];
    file.write_block(path, {i / components, i % components, 0, 0}, {1, 1, unknowns, 6},
                     columns.data());
  }
  for (std::size_t i = 0; i < initial.size(); ++i) write_parts(file, model, name, i, initial[i]);
}

void write_matrices(Hdf5File& file, const BodyModel& model, const Progress& progress) {
  MatrixWriter writer(file, matrix_bytes(model), progress);
  write_body_force(file, model, kBodyForce, model.body_force, model.initial_body_force);
  if (model.has_centrifugal())
    write_body_force(file, model, kCentrifugal, model.centrifugal, model.initial_centrifugal);
  const bool tractions = model.loads != Loads::none;
  const SpatialMethod method = model.discretisation.method;
  write_small(file, kBalancePath, model.balance);
  if (tractions) write_small(file, kTractionBalancePath, model.traction_balance);
  for (std::size_t i = 0; i < model.traction_moments.size(); ++i)
    write_parts(file, model, kTractionMoments, i, model.traction_moments[i]);
  const auto write_initial = [&](bool of_tractions,
                                 const std::vector<std::unique_ptr<MatrixFamily>>& families) {
    const char* name = initial_name(model.inverse_kind(), of_tractions);
    for (std::size_t i = 0; i < families.size(); ++i)
      writer.write({initial_path(name, i), initial_paths(name, i, families[i]->count())},
                   *families[i]);
    file.set_attribute(lags_path(name), "unit", matrix_unit(method, name));
  };
  write_initial(false, model.is_iterative() ? model.initial_h : model.inverse);
  if (tractions)
    write_initial(true, model.is_iterative() ? model.initial_g : model.traction_response);
  const auto write_lags = [&](const char* name, const MatrixFamily& family) {
    writer.write(
        {lags_path(name), lag_paths(name, model.discretisation.history_length, model.components())},
        family);
    file.set_attribute(lags_path(name), "unit", matrix_unit(method, name));
  };
  if (model.h) write_lags("h", *model.h);
  if (model.g) write_lags("g", *model.g);
  const auto write_single = [&](const char* group, const MatrixFamily* family, const char* unit) {
    if (!family) return;
    writer.write(single_place(group), *family);
    file.set_attribute(group, "unit", unit);
  };
  write_single(kStiffness, model.stiffness.get(), "N/m");
  write_single(kEnergyStiffness, model.energy_stiffness.get(), "N/m");
  write_single(kEnergyMass, model.energy_mass.get(), "kg");
}

void check_complete(const BodyModel& model) {
  const auto lags = static_cast<std::size_t>(model.discretisation.history_length) *
                    static_cast<std::size_t>(model.components());
  const std::size_t initial = model.discretisation.scheme.initial_components().size();
  const auto is_whole = [&](const std::unique_ptr<MatrixFamily>& family) {
    return (family ? family->count() : 0) == static_cast<int>(lags);
  };
  const bool iterative = model.is_iterative(), tractions = model.loads != Loads::none;
  const auto& h = iterative ? model.initial_h : model.inverse;
  const auto& g = iterative ? model.initial_g : model.traction_response;
  require(is_whole(model.h) && h.size() == initial && model.body_force.size() == lags &&
              model.initial_body_force.size() == initial &&
              (!tractions || (is_whole(model.g) && g.size() == initial)),
          "all matrices of a model that is archived are in memory");
}

}  // namespace

void check_archive_target(const std::string& path, bool force, double bytes) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status))
    throw Error(ErrorCode::usage, path + ": is a directory; name a file to write");
  if (std::filesystem::exists(status) && !force)
    throw Error(ErrorCode::usage, path + ": exists already; use --force to overwrite it");
  const PendingFile trial(path);
  check_free_space(path, bytes);
}

double archive_bytes(const BodyGeometry& geometry, const PrecomputeOptions& options,
                     double stored) {
  const Discretisation& d = options.discretisation;
  if (options.kind == ModelKind::rigid) return overhead_bytes(geometry, 0);
  const double lags = d.history_length * static_cast<double>(d.scheme.lag_components().size());
  const double kinds = (options.loads == Loads::none ? 1 : 2) + (options.energies ? 1 : 0);
  const Codec& codec = *options.codec.codec;
  if (!codec.is_sampled()) return stored + overhead_bytes(geometry, kinds * lags);
  const double matrices = kinds * (lags + d.scheme.initial_components().size() * 2.0);
  return stored + codec.expected_table_bytes(geometry.nodes.vertices, 2 * kinds, matrices) +
         overhead_bytes(geometry, 10 * kinds);
}

void write_archive(const std::string& path, const BodyModel& model, const Provenance& provenance,
                   bool force, const Progress& progress) {
  const bool rigid = model.kind == ModelKind::rigid;
  if (!rigid) check_complete(model);
  const double bytes =
      rigid ? overhead_bytes(model.geometry, 0)
            : matrix_bytes(model) + table_bytes(model) +
                  overhead_bytes(model.geometry,
                                 2.0 * model.discretisation.history_length * model.components());
  check_archive_target(path, force, bytes);
  PendingFile pending(path);
  Hdf5CreateOptions options;
  options.name = path;
  options.user_block = kUserBlock;
  Hdf5File file = Hdf5File::create(pending.temporary_path(), options);
  file.set_attribute("/", "format", "bem matrix archive");
  file.set_attribute("/", "format_version", kArchiveVersion);
  file.set_attribute("/", "model", choice_name(model.kind));
  write_geometry(file, model.geometry);
  write_material(file, model.discretisation.material);
  write_provenance(file, provenance);
  if (!rigid) {
    file.set_attribute("/", "codec", model.codec->name());
    if (model.codec->is_lossless())
      file.set_attribute("/", "precision", choice_name(*model.codec->precision()));
    file.set_attribute("/", "inverse", choice_name(model.inverse_kind()));
    file.set_attribute("/", "loads", choice_name(model.loads));
    if (model.loads == Loads::some) write_indices(file, kLoadedNodes[0].path, model.loaded_nodes);
    write_scheme(file, model);
    write_report(file, model.report);
    write_matrices(file, model, progress);
  }
  file.close();
  if (progress) progress("digest", 0);
  seal_archive(pending.temporary_path(), path);
  if (progress) progress("saving to disk", 0);
  pending.commit(force ? ExistingFile::replace : ExistingFile::keep);
}

}  // namespace bem
