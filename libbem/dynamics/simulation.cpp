#include "dynamics/simulation.hpp"

#include "base/error.hpp"
#include "mesh/describe.hpp"
#include "scene/location.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

namespace bem {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::size_t bytes_of(const BodyModel& m) {
  std::size_t bytes = 0;
  for (const auto& h : m.h) bytes += h->bytes();
  for (const SpectralMatrix& s : m.inverse)
    bytes += s.real->bytes() + (s.imaginary ? s.imaginary->bytes() : 0);
  return bytes;
}

}  // namespace

void check_time_step(const Scene& scene, const BodySpec& body, double dt) {
  if (std::abs(dt - scene.time_step) <= 1e-9 * dt) return;
  throw Error(ErrorCode::archive,
              where(body.archive.location) + ": the archive " + in_quotes(body.archive.written) +
                  " was made for the time step " + to_text(dt) + " s, the scene has " +
                  to_text(scene.time_step) + " s (" + where(scene.time_step_location) +
                  "); make the archive again with --dt " + to_text(scene.time_step) +
                  ", or change the scene");
}

long step_count(double duration, double time_step) {
  return std::lround(duration / time_step);
}

Simulation::Simulation(const Scene& scene, ModelSource& source) : scene_(scene) {
  std::map<std::string, std::vector<const BodySpec*>> by_archive;
  for (const BodySpec& body : scene_.bodies) by_archive[body.archive.resolved].push_back(&body);
  std::map<std::string, SharedModel> shared;
  for (const auto& [path, users] : by_archive) {
    SharedModel s;
    s.model = source.model(users[0]->archive);
    for (const BodySpec* body : users) check_time_step(scene_, *body, s.model->discretisation.dt);
    s.system = std::make_shared<ElasticSystem>(*s.model);
    std::vector<int> unknowns;
    bool loaded = false;
    for (const BodySpec* body : users) {
      for (const PrescribedNode& p : prescribed_nodes(s.model->geometry, *body))
        for (int axis = 0; axis < 3; ++axis) unknowns.push_back(3 * p.node + axis);
      loaded = loaded || !body->tractions.empty();
    }
    std::sort(unknowns.begin(), unknowns.end());
    unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
    if (!unknowns.empty()) s.tractions = source.tractions(users[0]->archive, unknowns);
    if (loaded)
      s.assembler = std::make_shared<RowAssembler>(
          s.model->geometry.nodes, s.model->geometry.extent, s.model->discretisation);
    matrix_bytes_ += bytes_of(*s.model);
    ++archives_;
    shared[path] = std::move(s);
  }
  for (const BodySpec& body : scene_.bodies)
    bodies_.emplace_back(body, shared[body.archive.resolved], scene_.time_step, scene_.gravity);
}

void Simulation::step() {
  const double start = now();
  for (Body& body : bodies_) body.begin_step();
  const double solve = now();
  for (Body& body : bodies_) body.solve_constraints();
  const double correct = now();
  for (Body& body : bodies_) body.end_step();
  times_.unconstrained += solve - start;
  times_.constraints += correct - solve;
  times_.correction += now() - correct;
  ++steps_;
}

}  // namespace bem
