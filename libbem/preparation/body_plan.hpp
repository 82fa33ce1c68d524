#pragma once

#include "archive/provenance.hpp"
#include "model/precompute.hpp"
#include "preparation/time_step.hpp"
#include "scene/body_spec.hpp"
#include "settings/precompute_settings.hpp"

#include <string>
#include <vector>

namespace bem {

/// What the matrices of a body are computed from, beside its mesh.
struct BodyInputs {
  std::string mesh;  ///< path, for messages
  double mesh_scale = 1;
  Material material;
  std::string material_name;  ///< a path or a name, for messages
  PrecomputeSettings settings;
  /// The vertices that contacts, joints and fixed vertices may act on, in place of
  /// `settings.loads` "all"; empty: as that says.
  std::vector<Selection> loaded;
};

/// The body that the inputs describe, checked.
struct BodyPlan {
  BodyGeometry geometry;
  PrecomputeSettings settings;  ///< of the inputs, with another discretisation where one is needed
  PrecomputeOptions options;
  double lam = 0;  ///< time steps that a shear wave takes across the body
  std::vector<std::string> warnings, notes;
};

/// Checks the mesh, which is given as it is in its file. A body for which the default
/// discretisation is not made gets another one, with a warning; without a time step it gets
/// automatic_time_step(), with a note. Throws ErrorCode::invalid_input for a mesh that cannot be
/// used, and ErrorCode::usage for a time step or a history that cannot.
BodyPlan plan_body(TriangleMesh mesh, const BodyInputs& inputs, SettingStyle style);

/// What automatic_time_step() looks at. Throws as plan_body().
WaveTimes wave_times(TriangleMesh mesh, const BodyInputs& inputs);

/// What the archive of a planned body says of where it comes from.
Provenance provenance_of(const BodyInputs& inputs, const BodyPlan& plan,
                         const std::string& program);

}  // namespace bem
