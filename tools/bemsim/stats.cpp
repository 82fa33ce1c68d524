#include "stats.hpp"

#include "base/parallel.hpp"
#include "common/cli.hpp"

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

void RunStatistics::record_step(const Simulation& simulation) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const SolveStatistics& s = simulation.bodies()[i].statistics();
    bodies_[i].iterations += s.iterations;
    bodies_[i].most_iterations = std::max(bodies_[i].most_iterations, s.iterations);
    bodies_[i].largest_residual = std::max(bodies_[i].largest_residual, s.residual);
  }
}

Json RunStatistics::body_json(const PlannedBody& planned, const Body& body,
                              const BodyRecord& record, long steps) const {
  const BodyModel& model = body.model();
  return {{"name", body.name()},
          {"archive", planned.spec->archive.written},
          {"vertices", model.geometry.input.vertices.size()},
          {"prescribed_vertices", body.prescribed()},
          {"loads", body.loads()},
          {"window", model.window},
          {"growth", model.report.growth},
          {"iterations",
           {{"max", record.most_iterations},
            {"mean", per_step(static_cast<double>(record.iterations), steps)}}},
          {"largest_residual", record.largest_residual},
          {"linear_momentum", vector_json(body.linear_momentum())},
          {"angular_momentum", vector_json(body.frame().angular_momentum())}};
}

Json RunStatistics::json(const Plan& plan, const Simulation& simulation, const PhaseTimer& timer,
                         const std::string& outcome) const {
  const long steps = simulation.steps();
  double wall = 0, cpu = 0;
  for (const PhaseTimer::Phase& p : timer.phases()) {
    wall += p.wall_seconds;
    cpu += p.cpu_seconds;
  }
  Json bodies = Json::array();
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    bodies.push_back(body_json(plan.bodies[i], simulation.bodies()[i], bodies_[i], steps));
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
          {"bodies", bodies},
          {"warnings", plan.warnings}};
}

}  // namespace bem
