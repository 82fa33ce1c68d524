#include "archive/archive_reader.hpp"

#include "archive/archive_layout.hpp"
#include "archive/scheme_tables.hpp"
#include "base/narrow.hpp"
#include "files/file_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

namespace bem {
namespace {

constexpr double kSchemeTolerance = 1e-10;

/// The structure of the file is checked before the HDF5 library reads it in this process.
Hdf5File open_checked(const std::string& path) {
  check_hdf5_file(path, Hdf5Storage::whole, ErrorCode::archive);
  return Hdf5File::open(path, ErrorCode::archive);
}

}  // namespace

Archive::Archive(const std::string& path)
    : user_block_(verify_digest(path)), file_(open_checked(path)) {
  require_text("format", "bem matrix archive");
  if (file_.int_attribute("/", "format_version") != user_block_.version)
    refuse("its format version is not that of its header");
  read_kind();
  if (kind_ != ModelKind::rigid) read_storage();
  read_geometry();
  read_material();
  check_body();
  read_provenance();
  if (kind_ == ModelKind::rigid) return;
  read_discretisation();
  read_report();
  check_matrix_datasets();
}

template <class T>
T Archive::read_choice(const std::string& name, T missing, const char* group) const {
  if (!file_.has_attribute(group, name)) return missing;
  const std::string text = file_.string_attribute(group, name);
  const std::optional<T> value = find_choice<T>(text);
  if (!value)
    refuse("has the " + name + " \"" + text + "\", but this version of the program understands " +
           choice_list<T>() + " only");
  return *value;
}

void Archive::read_kind() {
  file_.string_attribute("/", "model");  // must be there
  kind_ = read_choice("model", kind_);
}

/// What is stored, and how. Archives without "inverse" or "loads" have everything.
void Archive::read_storage() {
  inverse_ = read_choice("inverse", inverse_);
  loads_ = read_choice("loads", loads_);
  const std::string name = file_.string_attribute("/", "codec");
  codec_ = find_codec(name);
  if (!codec_)
    refuse("has the codec \"" + name + "\", but this version of the program understands " +
           list_text(codec_names()) + " only");
  if (!codec_->is_lossless()) return;
  file_.string_attribute("/", "precision");  // must be there
  codec_ = find_codec(name, read_choice("precision", Precision::float32));
}

void Archive::refuse(const std::string& what) const {
  throw Error(ErrorCode::archive, path() + ": " + what);
}

void Archive::require_text(const std::string& name, const std::string& expected) const {
  const std::string value = file_.string_attribute("/", name);
  if (value != expected)
    refuse("has the " + name + " \"" + value +
           "\", but this version of the program understands \"" + expected + "\" only");
}

std::vector<Vec3> Archive::read_points(const std::string& path) const {
  const std::vector<double> data = file_.read<double>(path);
  check_finite(data.data(), data.size(), path);
  std::vector<Vec3> points;
  points.reserve(data.size() / 3);
  for (std::size_t i = 0; i < data.size(); i += 3)
    points.emplace_back(data[i], data[i + 1], data[i + 2]);
  return points;
}

std::vector<int> Archive::read_indices(const std::string& path, int lowest, std::size_t end) const {
  const std::vector<std::int32_t> data = file_.read<std::int32_t>(path);
  for (std::int32_t index : data)
    if (index < lowest || index >= static_cast<std::int64_t>(end))
      refuse(path + " has an index out of range");
  return {data.begin(), data.end()};
}

std::vector<Triangle> Archive::read_triangles(const std::string& path, std::size_t vertices) const {
  const std::vector<int> corners = read_indices(path, 0, vertices);
  std::vector<Triangle> triangles(corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); ++i) triangles[i / 3][i % 3] = corners[i];
  return triangles;
}

void Archive::read_geometry() {
  contents_.check_datasets(file_, kGeometryDatasets);
  check_numbers(file_, kGeometryNumbers);
  BodyGeometry& g = geometry_;
  g.input.vertices = read_points("/mesh/vertices");
  g.input.triangles = read_triangles("/mesh/faces", g.input.vertices.size());
  g.nodes.vertices = read_points("/body/nodes");
  g.nodes.triangles = read_triangles("/body/triangles", g.nodes.vertices.size());
  g.node_of_vertex = read_indices("/body/node_of_vertex", -1, g.nodes.vertices.size());
  g.triangle_order = read_indices("/body/triangle_order", 0, g.input.triangles.size());
  g.mass.centre = read_points("/body/centre_of_mass")[0];
  const std::vector<Vec3> inertia = read_points("/body/inertia");
  for (int i = 0; i < 3; ++i) g.mass.inertia.row(i) = inertia[i].transpose();
  g.mass.volume = file_.double_attribute("/body", "volume");
  g.mass.mass = file_.double_attribute("/body", "mass");
  g.extent = file_.double_attribute("/body", "extent");
  if (file_.has_attribute("/body", "corner_angle_deg"))
    g.corner_angle_deg = file_.double_attribute("/body", "corner_angle_deg");
  narrow<std::int32_t>(3 * g.nodes.vertices.size(), ErrorCode::archive,
                       path() + ": the number of nodes");
  read_loaded_nodes();
}

void Archive::read_loaded_nodes() {
  if (loads_ != Loads::some) return;
  contents_.check_datasets(file_, kLoadedNodes);
  loaded_nodes_ = read_indices(kLoadedNodes[0].path, 0, geometry_.nodes.vertices.size());
  if (std::adjacent_find(loaded_nodes_.begin(), loaded_nodes_.end(), std::greater_equal<>()) !=
      loaded_nodes_.end())
    refuse(std::string(kLoadedNodes[0].path) + " does not ascend");
}

void Archive::read_material() {
  Material& m = discretisation_.material;
  m.name = file_.string_attribute("/material", "name");
  m.density = file_.double_attribute("/material", "density");
  m.shear_modulus = file_.double_attribute("/material", "shear_modulus");
  m.poisson_ratio = file_.double_attribute("/material", "poisson_ratio");
  if (file_.has_attribute("/material", "time_step"))
    m.time_step = file_.double_attribute("/material", "time_step");
  if (!std::isnormal(m.shear_speed()))
    refuse("has a material whose speed of shear waves is out of range");
}

/// As meshes of bodies are checked.
void Archive::check_body() const {
  try {
    check_geometry(geometry_, discretisation_.material.density, path());
  } catch (const Error& e) {
    throw Error(ErrorCode::archive, e.what());
  }
}

void Archive::read_discretisation() {
  check_numbers(file_, kSchemeNumbers);
  Discretisation& d = discretisation_;
  const bool dynamic = kind_ == ModelKind::dynamic;
  if (dynamic) check_numbers(file_, kDynamicNumbers);
  d.dt = dynamic ? file_.double_attribute("/scheme", "dt")
                 : quasistatic_time_step(geometry_, d.material);
  d.history_length = narrow<int>(file_.int_attribute("/scheme", "history_length"),
                                 ErrorCode::archive, path() + ": the length of the history");
  if (dynamic != (d.history_length > 0)) refuse("has an impossible length of the history");
  d.quadrature_tolerance = file_.double_attribute("/scheme", "quadrature_tolerance");
  window_ = file_.double_attribute("/scheme", "window");
  if (file_.has_attribute("/scheme", "damping_time"))
    d.damping.time = file_.double_attribute("/scheme", "damping_time");
  const std::string name = file_.string_attribute("/scheme", "name");
  try {
    d.scheme = Scheme::parse(name);
  } catch (const Error& e) {
    refuse(e.what());
  }
  d.method = read_choice("discretisation", SpatialMethod::collocation, "/scheme");
  if (!dynamic && !d.scheme.is_multistep()) refuse("is static and has a scheme with stages");
  check_scheme();
}

/// The matrices belong to components of the scheme: are they the ones that this program uses?
void Archive::check_scheme() {
  const Scheme& scheme = discretisation_.scheme;
  const auto stages = static_cast<std::size_t>(scheme.stages());
  contents_.expect(Count::stages, stages);
  contents_.expect(Count::stage_parts, 2 * stages);
  contents_.expect(Count::lag_components, scheme.lag_components().size());
  contents_.expect(Count::initial_components, scheme.initial_components().size());
  contents_.check_datasets(file_, kSchemeDatasets);
  double difference = 0;
  for (const SchemeTable& table : scheme_tables(scheme)) {
    const std::vector<double> found = file_.read<double>(table.path);
    check_finite(found.data(), found.size(), table.path);
    if (!table.is_unique) continue;
    const Eigen::Map<const SchemeTable::Values> theirs(found.data(), table.values.rows(),
                                                       table.values.cols());
    difference += (theirs - table.values).cwiseAbs().sum();
  }
  if (!(difference < kSchemeTolerance))
    refuse("its matrices are decomposed in another way than this program does");
}

void Archive::read_report() {
  report_.lam = file_.double_attribute("/report", "lam");
  const Discretisation& d = discretisation_;
  if (kind_ == ModelKind::dynamic) {
    const double lam = traversal_steps(geometry_, d.material, d.dt);
    if (!(std::abs(report_.lam - lam) <= 1e-6 * lam))
      refuse("its time step does not fit its body and material");
    if (is_too_short(d.history_length, lam)) refuse("has an impossible length of the history");
  }
  report_.row_sum_residual = file_.double_attribute("/report", "row_sum_residual");
  report_.rotation_residual = file_.double_attribute("/report", "rotation_residual");
  report_.condition = file_.double_attribute("/report", "condition");
  report_.growth = file_.double_attribute("/report", "growth");
  if (!file_.has_attribute("/report", "codec_error_h")) return;  // format version 1
  ModelReport::CodecErrors& e = report_.codec_errors;
  e.h = file_.double_attribute("/report", "codec_error_h");
  e.g = file_.double_attribute("/report", "codec_error_g");
  e.inverse = file_.double_attribute("/report", "codec_error_inverse");
  e.traction_response = file_.double_attribute("/report", "codec_error_traction_response");
  if (file_.has_attribute("/report", "codec_error_stiffness"))
    e.stiffness = file_.double_attribute("/report", "codec_error_stiffness");
  if (!file_.has_attribute("/report", "codec_error_initial_h")) return;
  e.initial_h = file_.double_attribute("/report", "codec_error_initial_h");
  e.initial_g = file_.double_attribute("/report", "codec_error_initial_g");
}

void Archive::read_provenance() {
  provenance_.program = file_.string_attribute("/provenance", "program");
  provenance_.mesh_file = file_.string_attribute("/provenance", "mesh_file");
  provenance_.material_file = file_.string_attribute("/provenance", "material_file");
  provenance_.mesh_scale = file_.double_attribute("/provenance", "mesh_scale");
  provenance_.options = file_.string_attribute("/provenance", "options");
}

bool Archive::is_paired(std::size_t initial_component) const {
  return discretisation_.scheme.initial_components()[initial_component].paired;
}

std::vector<Archive::PlacedFamily> Archive::families() const {
  std::vector<PlacedFamily> families;
  if (kind_ == ModelKind::rigid) return families;
  const bool tractions = loads_ != Loads::none;
  for (bool of_tractions : {false, true}) {
    if (of_tractions && !tractions) break;
    const char* matrix = initial_name(inverse_, of_tractions);
    for (std::size_t i = 0; i < discretisation_.scheme.initial_components().size(); ++i)
      families.push_back({{initial_path(matrix, i), initial_paths(matrix, i, is_paired(i) ? 2 : 1)},
                          of_tractions});
  }
  if (is_inertial()) families.push_back({single_place(kStiffness), false});
  if (has_energies())
    for (const char* group : {kEnergyStiffness, kEnergyMass})
      families.push_back({single_place(group), false});
  for (bool of_tractions : {false, true}) {
    if (discretisation_.history_length == 0 || (of_tractions && !tractions)) break;
    const char* matrix = of_tractions ? "g" : "h";
    families.push_back({{lags_path(matrix), lag_paths(matrix, discretisation_.history_length,
                                                      static_cast<int>(lag_components()))},
                        of_tractions});
  }
  return families;
}

std::vector<std::string> Archive::matrix_paths() const {
  std::vector<std::string> paths;
  for (const PlacedFamily& family : families())
    paths.insert(paths.end(), family.place.paths.begin(), family.place.paths.end());
  return paths;
}

BodyModel Archive::load_motion_matrices(const Progress& progress) const {
  return load(false, progress);
}

BodyModel Archive::load_all(const Progress& progress) const {
  return load(true, progress);
}

}  // namespace bem
