#pragma once

#include "mesh/obj_groups.hpp"
#include "scene/body_spec.hpp"

#include <map>
#include <string>

namespace bem {

/// Selections with names: those of a scene, and those that a mesh file has.
class Groups {
 public:
  Groups() = default;
  /// The groups of a mesh file: triangles by name (read_mesh_groups in mesh/mesh_io.hpp).
  explicit Groups(NamedRanges triangles) : of_mesh_(std::move(triangles)) {}
  void set_of_mesh(NamedRanges triangles) { of_mesh_ = std::move(triangles); }

  /// A group of the scene; it hides one of the mesh file that has the same name.
  void add(const std::string& name, const Selection& selection) { of_scene_[name] = selection; }

  /// Puts the selection of that name in place of one that names a group. Throws
  /// ErrorCode::invalid_input, with the names that there are and `hint`, if there is none.
  void resolve(Selection& selection, const std::string& hint = "") const;
  /// The same for all selections of a body.
  void resolve(BodySpec& body, const std::string& hint = "") const;

 private:
  Error unknown(const Selection& selection, const std::string& hint) const;

  std::map<std::string, Selection> of_scene_;
  NamedRanges of_mesh_;
};

}  // namespace bem
