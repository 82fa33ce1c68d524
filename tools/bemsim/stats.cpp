#include "stats.hpp"

#include "base/parallel.hpp"
#include "common/cli.hpp"
#include "validity.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace bem {
namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

double per_step(double total, long steps) {
  return steps > 0 ? total / static_cast<double>(steps) : 0;
}

double wall_seconds(const PhaseTimer& timer, const std::string& phase) {
  for (const PhaseTimer::Phase& p : timer.phases())
    if (p.name == phase) return p.wall_seconds;
  return 0;
}

Json phases_json(const PhaseTimes& times, double output, long steps) {
  Json phases;
  const auto add = [&](const char* name, double seconds) {
    phases[name] = {{"total_seconds", seconds}, {"mean_seconds", per_step(seconds, steps)}};
  };
  add("unconstrained", times.unconstrained);
  add("collision", times.collision);
  add("constraints", times.constraints);
  add("correction", times.correction);
  add("output", output);
  return phases;
}

}  // namespace

std::optional<std::string> RunStatistics::record_step(const Simulation& simulation) {
  const ConstraintStatistics& s = simulation.statistics();
  sum_.contacts += s.contacts;
  sum_.iterations += s.iterations;
  sum_.sweeps += s.sweeps;
  sum_.newton_steps += s.newton_steps;
  most_.contacts = std::max(most_.contacts, s.contacts);
  most_.iterations = std::max(most_.iterations, s.iterations);
  most_.sweeps = std::max(most_.sweeps, s.sweeps);
  most_.newton_steps = std::max(most_.newton_steps, s.newton_steps);
  most_.joint_residual = std::max(most_.joint_residual, s.joint_residual);
  most_.contact_error = std::max(most_.contact_error, s.contact_error);
  most_.contact_residual = std::max(most_.contact_residual, s.contact_residual);
  most_.complementarity = std::max(most_.complementarity, s.complementarity);
  most_.penetration = std::max(most_.penetration, s.penetration);
  contact_steps_ += s.contacts > 0;
  vibrations_.record(simulation);
  coarse_.record(simulation);
  return unmet_.record(simulation);
}

std::vector<std::string> RunStatistics::warnings(const Plan& plan,
                                                 const Simulation& simulation) const {
  std::vector<std::string> out = vibrations_.warnings(simulation, plan.steps);
  if (const auto unmet = unmet_.warning(simulation.steps(), plan.scene.contact,
                                        plan.impossible(simulation.time())))
    out.push_back(*unmet);
  for (const Body& body : simulation.bodies())
    if (auto text = validity_warning(body)) out.push_back(std::move(*text));
  return out;
}

Json RunStatistics::constraints_json(long steps) const {
  const auto count = [&](int most, int sum) {
    return Json{{"max", most}, {"mean", per_step(sum, steps)}};
  };
  return {{"iterations", count(most_.iterations, sum_.iterations)},
          {"contacts", count(most_.contacts, sum_.contacts)},
          {"steps_with_contact", contact_steps_},
          {"steps_not_converged", unmet_.steps()},
          {"not_met", unmet_.json()},
          {"solver_sweeps", count(most_.sweeps, sum_.sweeps)},
          {"solver_newton_steps", count(most_.newton_steps, sum_.newton_steps)},
          {"largest_joint_residual", most_.joint_residual},
          {"largest_contact_error", most_.contact_error},
          {"largest_contact_residual", most_.contact_residual},
          {"largest_complementarity", most_.complementarity},
          {"largest_penetration", most_.penetration}};
}

namespace {

Json momentum_json(const MomentumBalance& m) {
  return {{"start", vector_json(m.start)},
          {"end", vector_json(m.end)},
          {"impulses",
           {{"gravity", vector_json(m.impulses.gravity)},
            {"loads", vector_json(m.impulses.loads)},
            {"obstacles", vector_json(m.impulses.obstacles)},
            {"joints_to_world", vector_json(m.impulses.joints)},
            {"window", vector_json(m.impulses.window)}}},
          {"defect", m.defect()},
          {"relative_defect", m.relative_defect()},
          {"angular_start", vector_json(m.angular_start)},
          {"angular_end", vector_json(m.angular_end)}};
}

Json body_json(const PlannedBody& planned, const Body& body, const Json& coarseness,
               const Json& growing) {
  const BodyModel& model = body.model();
  Json out{{"name", body.name()},
           {"archive", planned.spec->archive.written},
           {"vertices", model.geometry.input.vertices.size()},
           {"prescribed_vertices", planned.fixed + planned.handled},
           {"loads", body.loads().size()},
           {"window", model.window}};
  if (model.report.growth > 0) out["growth"] = model.report.growth;
  out["linear_momentum"] = vector_json(body.linear_momentum());
  out["angular_momentum"] = vector_json(body.frame().angular_momentum());
  out["validity"] = validity_json(body);
  if (!coarseness.is_null()) out["coarseness"] = coarseness;
  if (!growing.is_null()) out["growing_vibration"] = growing;
  return out;
}

}  // namespace

Json RunStatistics::json(const Plan& plan, const Simulation& simulation, const PhaseTimer& timer,
                         const std::string& outcome) const {
  const long steps = simulation.steps();
  double wall = 0, cpu = 0;
  for (const PhaseTimer::Phase& p : timer.phases()) {
    wall += p.wall_seconds;
    cpu += p.cpu_seconds;
  }
  Json bodies = Json::array();
  for (std::size_t i = 0; i < plan.bodies.size(); ++i)
    bodies.push_back(body_json(plan.bodies[i], simulation.bodies()[i], coarse_.json(simulation, i),
                               vibrations_.json(i, plan.scene.time_step)));
  std::vector<std::string> all = plan.warnings;
  for (std::string& text : warnings(plan, simulation)) all.push_back(std::move(text));
  return {{"program", version_text()},
          {"scene", plan.scene.location.file},
          {"outcome", outcome},
          {"threads", thread_count()},
          {"time_step", plan.scene.time_step},
          {"steps", steps},
          {"planned_steps", plan.steps},
          {"time", simulation.time()},
          {"frames", frames_},
          {"wall_seconds", wall},
          {"cpu_seconds", cpu},
          {"loading_seconds", wall_seconds(timer, kLoadingPhase)},
          {"peak_memory_bytes", peak_memory()},
          {"matrix_bytes", simulation.matrix_bytes()},
          {"phases", phases_json(simulation.times(), wall_seconds(timer, kOutputPhase), steps)},
          {"constraints", constraints_json(steps)},
          {"momentum", momentum_json(simulation.momentum())},
          {"bodies", bodies},
          {"warnings", all}};
}

}  // namespace bem
