#include "growing_vibrations.hpp"

#include "common/cli.hpp"
#include "mesh/describe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include <nlohmann/json.hpp>

namespace bem {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// When what the scene does to a body stops changing; never for one that is free, whose growth
/// bemprecomp has measured, or that a joint brings the motion of another body.
double quiet_from(const Scene& scene, std::size_t body) {
  const BodySpec& spec = scene.bodies[body];
  if (spec.fixed.empty() && spec.handles.empty()) return kNever;
  double out = 0;
  for (const TractionSpec& load : spec.tractions)
    if (!load.profile.empty()) out = std::max(out, load.profile.back().time);
  for (const HandleSpec& handle : spec.handles) {
    if (!handle.motion.empty()) out = std::max(out, handle.motion.back().time);
    if (handle.release_time) out = std::max(out, *handle.release_time);
  }
  for (const JointSpec& joint : scene.joints)
    if (joint.b && (joint.a.body == body || joint.b->body == body)) out = kNever;
  return out;
}

std::string rounded(double value, int digits) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

}  // namespace

GrowingVibrations::GrowingVibrations(const Scene& scene) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    bodies_.push_back({quiet_from(scene, i), {}});
}

void GrowingVibrations::record(const Simulation& simulation) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = simulation.bodies()[i];
    Watched& watched = bodies_[i];
    if (!body.model().has_history()) continue;
    if (body.contact_nodes().empty() && simulation.time() > watched.quiet_from)
      watched.watch.add(body.displacement());
    else
      watched.watch.interrupt();
  }
}

std::vector<std::string> GrowingVibrations::warnings(const Simulation& simulation,
                                                     long steps) const {
  constexpr double kNoticeable = 1.05;
  const double dt = simulation.scene().time_step;
  std::vector<std::string> out;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const std::optional<Vibration> v = bodies_[i].watch.growing();
    if (!v || std::pow(v->growth, static_cast<double>(steps)) < kNoticeable) continue;
    const Body& body = simulation.bodies()[i];
    const double rate = std::log(v->growth) / dt, angular = 2 * kPi * v->frequency / dt;
    out.push_back("the body " + in_quotes(body.name()) + " vibrates with " +
                  rounded(v->frequency / dt, 4) + " Hz, more by " +
                  rounded(100 * (std::pow(v->growth, 1 / v->frequency) - 1), 2) +
                  " % from period to period though nothing drives it, an error of the mesh: make "
                  "its archive from a finer one, with --window " +
                  rounded(body.model().window / v->growth, 6) +
                  ", or with --damping kelvin_voigt:" + rounded(2 * rate / (angular * angular), 2));
  }
  return out;
}

nlohmann::ordered_json GrowingVibrations::json(std::size_t body, double time_step) const {
  const std::optional<Vibration> v = bodies_[body].watch.growing();
  if (!v) return nullptr;
  return {{"frequency", v->frequency / time_step}, {"growth", v->growth}};
}

void GrowingVibrations::visit_state(StateArchive& state) {
  for (Watched& watched : bodies_) state(watched.watch);
}

}  // namespace bem
