#include "plan.hpp"

#include "archive/archive_writer.hpp"
#include "mesh/mesh_io.hpp"
#include "model/memory_estimate.hpp"
#include "scene/named_materials.hpp"

namespace bem {

Plan make_plan(const Options& o) {
  Plan plan;
  plan.inputs.mesh = o.mesh;
  plan.inputs.mesh_scale = o.mesh_scale;
  plan.inputs.material = find_material(o.material);
  plan.inputs.material_name = o.material;
  plan.inputs.settings = o.settings;
  plan.body = plan_body(simulated_mesh(read_mesh(o.mesh), plan.inputs, SettingStyle::option),
                        plan.inputs, SettingStyle::option);
  const BodyGeometry& geometry = plan.body.geometry;
  const PrecomputeOptions& options = plan.body.options;
  plan.stored = stored_bytes(geometry, options);
  plan.peak = peak_bytes(geometry, options, plan.stored);
  plan.archive_bytes = archive_bytes(geometry, options, plan.stored);
  return plan;
}

}  // namespace bem
