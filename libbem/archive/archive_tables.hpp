#pragma once

#include "files/hdf5_types.hpp"

#include <array>
#include <limits>

// The layout of an archive as data: what docs/archive-format.md says in words.

namespace bem {

/// An extent of a dataset that is not a fixed number: the same count wherever it stands.
enum class Count {
  vertices,
  triangles,
  nodes,
  unknowns,  ///< 3 nodes
  loaded,    ///< nodes that contacts and joints may act on
  stages,
  stage_parts,  ///< 2 stages: real and imaginary ones
  lag_components,
  initial_components,
  lags,
  bytes,  ///< any number, another one in every dataset; the tables of families say how many
  kinds   ///< number of counts
};

/// A fixed number or a count.
struct Extent {
  constexpr Extent(int number) : fixed(number) {}               // NOLINT: tables are to be read
  constexpr Extent(Count symbol) : fixed(-1), count(symbol) {}  // NOLINT
  int fixed;
  Count count = Count::kinds;
};

/// A dataset of an archive, or of the group of a family.
struct StoredDataset {
  const char* path;
  Hdf5Type type;
  int rank;
  std::array<Extent, 4> extents;
};

/// A number among the attributes of a group, with its range (both ends included).
struct StoredNumber {
  const char* group;
  const char* name;
  double least, most;
  bool optional = false;
};

/// Least of what must be positive.
inline constexpr double kPositive = std::numeric_limits<double>::min();
inline constexpr double kAny = std::numeric_limits<double>::max();

// The tables of the parts of an archive.

inline constexpr StoredDataset kGeometryDatasets[] = {
    {"/mesh/vertices", Hdf5Type::float64, 2, {Count::vertices, 3, 0, 0}},
    {"/mesh/faces", Hdf5Type::int32, 2, {Count::triangles, 3, 0, 0}},
    {"/body/nodes", Hdf5Type::float64, 2, {Count::nodes, 3, 0, 0}},
    {"/body/triangles", Hdf5Type::int32, 2, {Count::triangles, 3, 0, 0}},
    {"/body/node_of_vertex", Hdf5Type::int32, 1, {Count::vertices, 0, 0, 0}},
    {"/body/triangle_order", Hdf5Type::int32, 1, {Count::triangles, 0, 0, 0}},
    {"/body/centre_of_mass", Hdf5Type::float64, 1, {3, 0, 0, 0}},
    {"/body/inertia", Hdf5Type::float64, 2, {3, 3, 0, 0}},
};
inline constexpr StoredNumber kGeometryNumbers[] = {
    {"/body", "volume", kPositive, kAny},
    {"/body", "mass", kPositive, kAny},
    {"/body", "extent", kPositive, kAny},
    {"/body", "corner_angle_deg", 0, 180, true},
    {"/material", "density", kPositive, kAny},
    {"/material", "shear_modulus", kPositive, kAny},
    {"/material", "poisson_ratio", 0, 0.5},
    {"/material", "time_step", kPositive, kAny, true},
    {"/provenance", "mesh_scale", kPositive, kAny},
};

/// Of Loads::some.
inline constexpr StoredDataset kLoadedNodes[] = {
    {"/body/loaded_nodes", Hdf5Type::int32, 1, {Count::loaded, 0, 0, 0}}};

inline constexpr StoredNumber kSchemeNumbers[] = {
    {"/scheme", "history_length", 0, 1000000},
    {"/scheme", "quadrature_tolerance", kPositive, kAny},
    {"/scheme", "window", kPositive, 1},
    {"/scheme", "damping_time", kPositive, kAny, true},
    {"/report", "lam", 0, kAny},
    {"/report", "row_sum_residual", 0, kAny},
    {"/report", "rotation_residual", 0, kAny},
    {"/report", "condition", 0, kAny},
    {"/report", "growth", 0, kAny},
    {"/report", "codec_error_h", 0, kAny, true},  // from here on: not in format version 1
    {"/report", "codec_error_g", 0, kAny, true},
    {"/report", "codec_error_inverse", 0, kAny, true},
    {"/report", "codec_error_traction_response", 0, kAny, true},
    {"/report", "codec_error_initial_h", 0, kAny, true},
    {"/report", "codec_error_initial_g", 0, kAny, true},
    {"/report", "codec_error_stiffness", 0, kAny, true},
};
/// Of models that have a time step.
inline constexpr StoredNumber kDynamicNumbers[] = {{"/scheme", "dt", kPositive, kAny}};

inline constexpr StoredDataset kSchemeDatasets[] = {
    {"/scheme/stage_times", Hdf5Type::float64, 1, {Count::stages, 0, 0, 0}},
    {"/scheme/lag_left", Hdf5Type::float64, 2, {Count::lag_components, Count::stages, 0, 0}},
    {"/scheme/lag_right", Hdf5Type::float64, 2, {Count::lag_components, Count::stages, 0, 0}},
    {"/scheme/initial_eigenvalues", Hdf5Type::float64, 2, {Count::initial_components, 2, 0, 0}},
    {"/scheme/initial_multiplicity", Hdf5Type::float64, 2, {Count::initial_components, 1, 0, 0}},
    {"/scheme/initial_left",
     Hdf5Type::float64,
     2,
     {Count::initial_components, Count::stage_parts, 0, 0}},
    {"/scheme/initial_right",
     Hdf5Type::float64,
     2,
     {Count::initial_components, Count::stage_parts, 0, 0}},
};

/// In the groups of body forces.
inline constexpr StoredDataset kBodyForceLags[] = {
    {"/lags", Hdf5Type::float64, 4, {Count::lags, Count::lag_components, Count::unknowns, 6}}};
inline constexpr StoredDataset kBodyForceInitial[] = {
    {"", Hdf5Type::float64, 2, {Count::unknowns, 6, 0, 0}}};
inline constexpr StoredDataset kBalance[] = {
    {"", Hdf5Type::float64, 2, {6, Count::unknowns, 0, 0}}};

}  // namespace bem
