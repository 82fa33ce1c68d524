#include "growing_vibrations.hpp"

#include "mesh/describe.hpp"
#include "model/growth.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

namespace bem {
namespace {

/// When what the scene does to a body stops changing. Nothing for one that need not be watched: it
/// is free, so that bemprecomp has measured its growth or knows that there is none, or a joint
/// brings it the motion of another body.
std::optional<double> quiet_from(const Scene& scene, std::size_t body) {
  const BodySpec& spec = scene.bodies[body];
  if (spec.fixed.empty() && spec.handles.empty()) return std::nullopt;
  for (const JointSpec& joint : scene.joints)
    if (joint.b && (joint.a.body == body || joint.b->body == body)) return std::nullopt;
  double out = 0;
  for (const TractionSpec& load : spec.tractions)
    if (!load.profile.empty()) out = std::max(out, load.profile.back().time);
  for (const HandleSpec& handle : spec.handles) {
    if (!handle.motion.empty()) out = std::max(out, handle.motion.back().time);
    if (handle.release_time) out = std::max(out, *handle.release_time);
  }
  return out;
}

}  // namespace

GrowingVibrations::GrowingVibrations(const Scene& scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (const auto time = quiet_from(scene, i)) watched_.push_back({i, *time, {}});
}

void GrowingVibrations::record(const Simulation& simulation) {
  for (Watched& w : watched_) {
    const Body& body = simulation.bodies()[w.body];
    const BodyModel& model = body.model();
    if (!model.has_history() || model.discretisation.is_galerkin()) continue;
    if (body.contact_nodes().empty() && simulation.time() > w.quiet_from)
      w.watch.add(body.displacement());
    else
      w.watch.interrupt();
  }
}

std::vector<std::string> GrowingVibrations::warnings(const Simulation& simulation,
                                                     long steps) const {
  constexpr double kNoticeable = 1.05;
  const double dt = simulation.scene().time_step;
  std::vector<std::string> out;
  for (const Watched& w : watched_) {
    const std::optional<Vibration> v = w.watch.growing();
    if (!v || std::pow(v->growth, static_cast<double>(steps)) < kNoticeable) continue;
    const Body& body = simulation.bodies()[w.body];
    const BodyModel& model = body.model();
    const double damping =
        model.discretisation.damping.time + dt * holding_damping(v->growth, v->frequency);
    out.push_back("the body " + in_quotes(body.name()) + " vibrates with " +
                  rounded_text(v->frequency / dt, 4) + " Hz, more by " +
                  rounded_text(100 * (std::pow(v->growth, 1 / v->frequency) - 1), 2) +
                  " % from period to period though nothing drives it, an error of the mesh: make "
                  "its archive from a finer one, with --discretisation galerkin, with --window " +
                  rounded_text(model.window / v->growth, 6) +
                  ", or with --damping kelvin_voigt:" + rounded_text(damping, 2));
  }
  return out;
}

nlohmann::ordered_json GrowingVibrations::json(std::size_t body, double time_step) const {
  for (const Watched& w : watched_) {
    if (w.body != body) continue;
    if (const auto v = w.watch.growing())
      return {{"frequency", v->frequency / time_step}, {"growth", v->growth}};
  }
  return nullptr;
}

void GrowingVibrations::visit_state(StateArchive& state) {
  for (Watched& w : watched_) state(w.watch);
}

}  // namespace bem
