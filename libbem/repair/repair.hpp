#pragma once

#include "mesh/triangle_mesh.hpp"
#include "repair/repair_options.hpp"

#include <string>
#include <vector>

namespace bem {

/// What was done to a mesh.
struct RepairReport {
  /// A sentence without a full stop for each step in its order, with numbers, such as "filled 2
  /// holes of 12 and 30 edges"; empty if the mesh stayed as it was.
  std::vector<std::string> steps;
  bool changed = false;
  bool sheet = false;         ///< the mesh had no inside and was given a thickness
  bool wrapped = false;       ///< the surface is a wrap around the mesh
  bool other_volume = false;  ///< remeshing has changed the volume by more than 5 %
};

struct RepairedMesh {
  TriangleMesh mesh;
  RepairReport report;
};

/// A closed surface of one solid, which make_surface() and check_single_solid() accept and which
/// does not intersect itself, as near as possible to the mesh; with options.nodes also a new
/// triangulation of it.
///
/// A mesh that is such a surface stays as it is, bit for bit. Otherwise each step of `automatic`
/// does no more than the next one: vertices are joined, triangles without area and repeated ones
/// dropped, edges split where vertices lie on them, triangles turned the same way, parts that touch
/// in a vertex or an edge moved apart, small holes filled, triangles that cross cut out and
/// replaced, small loose parts dropped. A surface that still is open is a sheet and becomes a plate
/// of options.thickness. What then is not accepted is wrapped (repair/wrap.hpp), with larger gaps
/// bridged until one solid results. `off` does nothing but remesh. Meshes of any size are treated
/// alike. Messages and steps give lengths in metres.
///
/// Throws ErrorCode::invalid_input if the mesh has no triangle, an index out of range, a coordinate
/// that is not finite or no extent, if `off` is to remesh a surface that is not accepted, or if
/// nothing worked; messages name `name` and the cure. Throws ErrorCode::usage as
/// check_repair_options(). Cost: seconds for 10^5 triangles.
RepairedMesh repair_mesh(const TriangleMesh& mesh, const RepairOptions& options,
                         const std::string& name);

/// Wraps the mesh whatever it is, as RepairMode::wrap does.
RepairedMesh wrap_mesh(const TriangleMesh& mesh, const RepairOptions& options,
                       const std::string& name);

/// What a message about a refused mesh ends with: "; mend it with \"bemshape repair IN -o
/// repaired.obj\"".
std::string repair_advice(const std::string& name);

}  // namespace bem
