#include "model/precompute.hpp"

#include "base/error.hpp"
#include "mesh/local_thickness.hpp"
#include "model/balance.hpp"
#include "model/energy_families.hpp"
#include "model/growth.hpp"
#include "model/model_assembly.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

/// The window that brings the measured growth down to 1. Throws if it would leave nothing of the
/// body's motion.
double automatic_window(const BodyModel& model) {
  constexpr double kLeastLeft = 0.01, kRounding = 1e-6;
  const double growth = model.report.growth;
  if (growth <= 1) return 1;
  const double window = (1 - kRounding) / growth;
  if (std::pow(window, std::max(1.0, model.report.lam)) >= kLeastLeft) return window;
  double edge = 0;
  for (const Triangle& t : model.geometry.nodes.triangles)
    for (int k = 0; k < 3; ++k)
      edge = std::max(edge, (model.geometry.nodes.vertices[t[k]] -
                             model.geometry.nodes.vertices[t[(k + 1) % 3]])
                                .norm());
  const Discretisation& d = model.discretisation;
  throw Error(ErrorCode::numerical,
              "motions grow by a factor of " + std::to_string(growth) +
                  " per step, and a window that prevents it would leave nothing of them; use " +
                  (d.is_galerkin() ? "" : "--discretisation galerkin or ") +
                  "a larger --dt (a shear wave goes " +
                  std::to_string(d.material.shear_speed() * d.dt / edge) +
                  " of the longest edge in a step; sharp edges with a Poisson ratio near 0.5 need "
                  "about 1), a finer mesh or a longer --history, or set --window yourself");
}

}  // namespace

CodecOptions codec_of_body(const BodyGeometry& geometry, SpatialMethod method, CodecOptions codec) {
  constexpr double kGraded = 0.1;  // size of the smallest triangles over that of the largest
  constexpr double kLeast = 0.01;  // of the tolerance
  constexpr double kFew = 0.05;    // of the triangles, of the nodes
  if (method != SpatialMethod::galerkin) return codec;
  // what few triangles have does not count
  const auto quantile = [](std::vector<double> values, double share) {
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
  };
  const std::vector<double> areas = vertex_areas(geometry.nodes);
  const double thin = quantile(local_thickness(geometry.nodes), kFew) / kThinBody,
               sizes = std::sqrt(quantile(areas, kFew) / quantile(areas, 1 - kFew)),
               graded = sizes / kGraded;
  codec.tolerance *= std::max(kLeast, std::min(1.0, thin) * std::min(1.0, graded));
  return codec;
}

BodyModel precompute(BodyGeometry geometry, const PrecomputeOptions& options,
                     const Progress& progress) {
  BodyModel model;
  model.kind = options.kind;
  model.geometry = std::move(geometry);
  model.discretisation = options.discretisation;
  if (options.kind == ModelKind::rigid) return model;
  model.codec = options.codec.codec;
  if (model.kind == ModelKind::dynamic)
    model.report.lam =
        traversal_steps(model.geometry, options.discretisation.material, options.discretisation.dt);
  model.loads = options.loads;
  model.loaded_nodes = options.loaded_nodes;
  require(model.kind == ModelKind::dynamic || options.inverse == InverseKind::dense,
          "a quasi-static model has an inverse");
  assemble_model(model, options, progress);
  if (progress) progress("static balance", 0);
  compute_balance(model);
  if (options.energies) add_energies(model, options, progress);
  model.window = options.window > 0 ? options.window : 1;
  if (options.measure_growth && model.has_history()) {
    if (progress) progress("growth factor", 0);
    const GrowthEstimate growth = growth_factor(model);
    model.report.growth = growth.factor;
    model.report.growth_frequency = growth.frequency / options.discretisation.dt;
    if (options.window == 0) model.window = automatic_window(model);
  }
  return model;
}

}  // namespace bem
