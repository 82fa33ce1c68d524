#pragma once

#include "archive/provenance.hpp"
#include "assembly/quadrature_count.hpp"
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
  RepairMode repair = RepairMode::off;  ///< where the settings do not say
  bool automatic_time_step = false;     ///< that of the settings was chosen
  /// The vertices that contacts, joints and fixed vertices may act on, in place of
  /// `settings.loads` "all"; empty: as that says.
  std::vector<Selection> loaded;
};

/// The mesh that is simulated: that of the file, or what a repair has made of it.
struct SimulatedMesh {
  TriangleMesh mesh;  ///< before it is scaled
  bool changed = false;
  std::vector<std::string> warnings, notes;  ///< of what was done to it
};

/// Repairs and remeshes a mesh as the settings say. Throws ErrorCode::invalid_input for a mesh that
/// cannot be used, with the setting that would mend it.
SimulatedMesh simulated_mesh(const TriangleMesh& file, const BodyInputs& inputs,
                             SettingStyle style);

/// The body that the inputs describe, checked.
struct BodyPlan {
  BodyGeometry geometry;
  std::string repair;           ///< the options of what was done to the mesh, or empty
  PrecomputeSettings settings;  ///< of the inputs, with another discretisation where one is needed
  PrecomputeOptions options;
  double lam = 0;  ///< time steps that a shear wave takes across the body
  QuadratureCount quadrature;
  std::vector<std::string> warnings, notes;
};

/// A body for which the default discretisation is not made gets another one, with a warning;
/// without a time step it gets automatic_time_step(), with a note. Throws ErrorCode::invalid_input
/// for a mesh that cannot be used, and ErrorCode::usage for a time step or a history that cannot.
BodyPlan plan_body(SimulatedMesh mesh, const BodyInputs& inputs, SettingStyle style);

/// Throws ErrorCode::resources if the matrices surely take more than `available` bytes while they
/// are computed.
void check_memory(const BodyPlan& plan, double available, SettingStyle style);

/// Of the simulated mesh, for automatic_time_step() [s].
double crossing_time(const SimulatedMesh& mesh, const BodyInputs& inputs);

/// What the archive of a planned body says of where it comes from.
Provenance provenance_of(const BodyInputs& inputs, const BodyPlan& plan,
                         const std::string& program);

}  // namespace bem
