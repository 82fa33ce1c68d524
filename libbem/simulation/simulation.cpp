#include "simulation/simulation.hpp"

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
  std::size_t bytes = m.h ? m.h->bytes() : 0;
  for (const auto* families : {&m.inverse, &m.initial_h})
    for (const auto& family : *families) bytes += family->bytes();
  return bytes;
}

/// A rigid body moves by any scheme; it takes that of the bodies around it.
std::shared_ptr<const BodyModel> rigid_with_scheme(const BodyModel& model, const Scheme& scheme) {
  auto out = std::make_shared<BodyModel>();
  out->kind = ModelKind::rigid;
  out->geometry = model.geometry;
  out->discretisation = model.discretisation;
  out->discretisation.scheme = scheme;
  return out;
}

FrictionMethod friction_method(ContactSolver solver) {
  switch (solver) {
    case ContactSolver::staggered:
      return FrictionMethod::staggered;
    case ContactSolver::nsgs:
      return FrictionMethod::nsgs;
    case ContactSolver::newton:
      break;
  }
  return FrictionMethod::newton;
}

/// Penetration, relative to the size of a body, with which the search for contacts of a step ends
/// after some passes.
double penetration_allowed(int passes) {
  return passes < 8 ? 0 : 2e-5;
}

}  // namespace

namespace {

void check_time_step(const Scene& scene, const BodySpec& body, double dt) {
  if (std::abs(dt - scene.time_step) <= 1e-9 * dt) return;
  throw Error(ErrorCode::archive,
              where(body.archive.location) + ": the archive " + in_quotes(body.archive.written) +
                  " was made for the time step " + to_text(dt) + " s, the scene has " +
                  to_text(scene.time_step) + " s (" + where(scene.time_step_location) +
                  "); make the archive again with --dt " + to_text(scene.time_step) +
                  ", or change the scene");
}

void check_correction(const BodySpec& body, ModelKind kind, const Scheme& scheme) {
  if (body.correction == Correction::projection) return;
  const bool dynamic = kind == ModelKind::dynamic;
  if (dynamic && scheme.is_multistep()) return;
  throw Error(ErrorCode::archive,
              where(body.archive.location) + ": the correction \"least_squares\" of the body " +
                  in_quotes(body.name) +
                  " needs an archive of a dynamic body with the scheme "
                  "bdf1, bdf2 or theta:T, but " +
                  in_quotes(body.archive.written) +
                  (dynamic ? " has the scheme " + scheme.name() : " is of another model") +
                  "; make it again, or use the correction \"projection\"");
}

}  // namespace

void check_archive(const Scene& scene, const BodySpec& body, ModelKind kind,
                   const Discretisation& discretisation) {
  if (kind == ModelKind::dynamic) check_time_step(scene, body, discretisation.dt);
  check_correction(body, kind, discretisation.scheme);
}

std::vector<Scheme> body_schemes(const Scene& scene,
                                 const std::vector<const Discretisation*>& deformable) {
  Scheme common = Scheme::radau2();
  for (auto d = deformable.rbegin(); d != deformable.rend(); ++d)
    if (*d) common = (*d)->scheme;
  std::vector<Scheme> schemes;
  for (const Discretisation* d : deformable) schemes.push_back(d ? d->scheme : common);
  for (const JointSpec& joint : scene.joints) {
    if (!joint.b) continue;
    const std::size_t a = joint.a.body, b = joint.b->body;
    if (schemes[a].name() == schemes[b].name()) continue;
    throw Error(ErrorCode::archive,
                where(joint.location) + ": the joint connects " + in_quotes(scene.bodies[a].name) +
                    ", which moves by " + schemes[a].name() + ", with " +
                    in_quotes(scene.bodies[b].name) + ", which moves by " + schemes[b].name() +
                    "; make their archives with the same --scheme");
  }
  return schemes;
}

long step_count(double duration, double time_step) {
  return std::lround(duration / time_step);
}

Simulation::Simulation(const Scene& scene, ModelSource& source) : scene_(scene) {
  load(source);
  ConstraintOptions options;
  options.contact_tolerance = scene_.contact.tolerance;
  options.method = friction_method(scene_.contact.solver);
  constraints_.emplace(plan_, bodies_, options);
  momentum_.start = momentum_.end = total_momentum();
  momentum_.angular_start = momentum_.angular_end = total_angular_momentum();
  momentum_.scale = momentum_.start.norm();
  if (!scene_.contact.enabled) return;
  std::vector<ObstacleMesh> obstacles;
  for (const ObstacleSpec& o : scene_.obstacles)
    if (const auto* mesh = std::get_if<MeshObstacle>(&o.shape))
      obstacles.push_back({&o, source.obstacle(*mesh)});
  std::vector<std::pair<int, int>> joined;
  for (const JointSpec& j : scene_.joints)
    if (j.b) joined.emplace_back(static_cast<int>(j.a.body), static_cast<int>(j.b->body));
  collisions_.emplace(scene_, bodies_, obstacles, joined);
  overlaps_ = collisions_->overlaps();
}

void Simulation::load(ModelSource& source) {
  std::map<std::string, std::vector<int>> by_archive;
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b)
    by_archive[scene_.bodies[b].archive.resolved].push_back(static_cast<int>(b));
  std::map<std::string, SharedModel> models;
  std::vector<const BodyGeometry*> geometries(scene_.bodies.size());
  for (const auto& [path, users] : by_archive) {
    SharedModel& s = models[path];
    s.model = source.model(scene_.bodies[users[0]].archive);
    ++archives_;
    for (int b : users) {
      geometries[b] = &s.model->geometry;
      check_archive(scene_, scene_.bodies[b], s.model->kind, s.model->discretisation);
    }
  }
  plan_ = plan_joints(scene_, geometries);
  std::vector<const Discretisation*> deformable;
  for (const BodySpec& body : scene_.bodies) {
    const BodyModel& model = *models[body.archive.resolved].model;
    deformable.push_back(model.kind == ModelKind::rigid ? nullptr : &model.discretisation);
  }
  const std::vector<Scheme> schemes = body_schemes(scene_, deformable);
  for (const auto& [path, users] : by_archive) {
    SharedModel& s = models[path];
    if (s.model->kind == ModelKind::rigid) {
      s.model = rigid_with_scheme(*s.model, schemes[users[0]]);
      continue;
    }
    sharing_.push_back(users);
    s.system = std::make_shared<ElasticSystem>(*s.model);
    matrix_bytes_ += bytes_of(*s.model);
    if (std::any_of(users.begin(), users.end(), [&](int b) {
          return scene_.bodies[b].correction == Correction::least_squares;
        }))
      s.correction = std::make_shared<LeastSquaresCorrection>(*s.system);
    if (s.model->has_centrifugal() && std::any_of(users.begin(), users.end(), [&](int b) {
          return scene_.bodies[b].has_centrifugal();
        }))
      s.centrifugal = std::make_shared<InputColumns>(
          s.system->make_columns(s.model->centrifugal, s.model->initial_centrifugal));
    const std::vector<int> nodes = touched_nodes(users, *s.model);
    if (!nodes.empty()) {
      s.tractions = std::make_shared<NodalTractions>(
          *s.system, source.tractions(scene_.bodies[users[0]].archive, nodes));
      matrix_bytes_ += s.tractions->bytes();
    }
    if (std::any_of(users.begin(), users.end(), [&](int b) {
          return !scene_.bodies[b].tractions.empty() || has_corner_loads(plan_.nodes[b]);
        }))
      s.assembler = make_load_assembler(s.model->geometry.nodes, s.model->geometry.extent,
                                        s.model->discretisation);
  }
  bodies_.reserve(scene_.bodies.size());
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    const SharedModel& s = models[scene_.bodies[b].archive.resolved];
    std::shared_ptr<const CornerLoads> corners;
    if (s.assembler) corners = make_corner_loads(*s.system, *s.assembler, plan_.nodes[b]);
    bodies_.emplace_back(scene_.bodies[b], s, scene_.time_step, scene_.gravity, plan_.nodes[b],
                         std::move(corners));
  }
}

/// Nodes that joints or contacts may act on, of bodies that share a model.
std::vector<int> Simulation::touched_nodes(const std::vector<int>& users,
                                           const BodyModel& model) const {
  std::vector<char> touched(model.nodes(), 0), available(model.nodes(), model.loads == Loads::all);
  for (int node : model.loaded_nodes) available[node] = 1;
  if (scene_.contact.enabled) touched = available;
  for (int b : users)
    for (const JointNode& n : plan_.nodes[b]) {
      if (!available[n.node])
        throw Error(ErrorCode::archive,
                    where(scene_.bodies[b].archive.location) + ": the archive " +
                        in_quotes(scene_.bodies[b].archive.written) +
                        " was made without loads on a vertex of the body " +
                        in_quotes(scene_.bodies[b].name) +
                        " that is fixed, moved or joined; make it again with --loads all");
      touched[n.node] = 1;
    }
  std::vector<int> nodes;
  for (std::size_t i = 0; i < touched.size(); ++i)
    if (touched[i]) nodes.push_back(static_cast<int>(i));
  return nodes;
}

/// The motion without new forces: products with the history, once for bodies of the same archive.
void Simulation::begin_step() {
  const auto begin = [&](int b, SpectralState free) {
    bodies_[b].begin_step(std::move(free), constraints_->is_held(b), constraints_->holder(b));
  };
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    if (bodies_[b].is_rigid()) begin(static_cast<int>(b), {});
  for (const std::vector<int>& group : sharing_) {
    std::vector<const MotionHistory*> motions;
    std::vector<Eigen::MatrixXd> sums;
    for (int b : group) {
      motions.push_back(&bodies_[b].motion_history());
      sums.push_back(bodies_[b].history_sums());
    }
    const ElasticSystem& system = bodies_[group[0]].system();
    system.subtract_motion_history(motions, sums);
    std::vector<SolutionMemory*> memories;
    for (int b : group)
      if (system.model().is_iterative()) memories.push_back(&bodies_[b].solution_memory());
    std::vector<SpectralState> states = system.solve(sums, motions, memories);
    for (std::size_t i = 0; i < group.size(); ++i) begin(group[i], std::move(states[i]));
  }
}

/// Solves for the known contacts, and adds up what it takes.
void Simulation::solve_contacts(double goal) {
  const double start = now();
  const ConstraintStatistics last = statistics_;
  statistics_ = constraints_->solve(contacts_.pairs(), goal);
  statistics_.iterations += last.iterations;
  statistics_.sweeps += last.sweeps;
  statistics_.newton_steps += last.newton_steps;
  times_.constraints += now() - start;
}

template <class Detect>
std::vector<ContactPair> Simulation::timed(const Detect& detect) {
  const double start = now();
  std::vector<ContactPair> found = detect();
  times_.collision += now() - start;
  return found;
}

/// Starts from what touches at the start of the step.
void Simulation::start_contacts(bool friction) {
  constexpr double kFirstGoal = 1e-4;  // of a body's size
  contacts_.clear();
  contacts_.take(timed([&] { return collisions_->detect_at_rest(); }),
                 {scene_.contact.tolerance, 0, false, friction});
  if (!contacts_.empty()) solve_contacts(kFirstGoal * collisions_->smallest());
}

/// Adds contacts until the motion that they lead to breaks no others. The best motion met goes to
/// `best`.
bool Simulation::find_contacts(bool friction, Attempt& best) {
  constexpr int kMostPasses = 12, kMostPassesInfeasible = 3, kAllViewsFrom = 4;
  constexpr double kInexactness = 0.02;  // of the penetration
  constexpr double kExact = 0.1;         // of the tolerance: errors of all steps add up to a creep
  const double tolerance = scene_.contact.tolerance;
  bool exact = false;
  for (int pass = 0;; ++pass) {
    const std::vector<ContactPair> found = timed([&] { return collisions_->detect(bodies_); });
    const double allowed = std::max(tolerance, penetration_allowed(pass) * collisions_->smallest());
    const KnownContacts::Finding now = KnownContacts::judge(found, -allowed);
    statistics_.contacts_complete = now.broken.empty();
    statistics_.penetration = now.deepest;
    statistics_.contacts_met = statistics_.contacts_met && friction;
    if (now.deepest < best.penetration) {
      best = {now.deepest, statistics_, constraints_->solution(), now.broken};
    }
    if (now.broken.empty() && (exact || statistics_.contact_residual <= kExact * tolerance))
      return true;
    const bool hopeless = statistics_.infeasible && pass >= kMostPassesInfeasible;
    if (pass == kMostPasses || hopeless || statistics_.exhausted) return false;
    if (!now.broken.empty())
      contacts_.take(found, {-tolerance, -allowed, pass >= kAllViewsFrom, friction});
    exact = now.broken.empty();
    solve_contacts(exact ? 0 : kInexactness * now.deepest);
  }
}

/// Contact of the step. Where it cannot be solved for, friction is left out at first and then added
/// to the motion without it; in the end the motion is taken that leaves the least penetration.
void Simulation::collide() {
  constexpr double kDeep = 5e-4;  // of the smallest body
  Attempt best;
  broken_.clear();
  start_contacts(true);
  if (find_contacts(true, best)) return;
  const bool hopeless = best.statistics.infeasible || statistics_.exhausted;
  if (best.penetration > kDeep * collisions_->smallest() && !hopeless) {
    start_contacts(false);
    if (find_contacts(false, best)) {
      contacts_.restore_friction();
      solve_contacts(0);
      if (find_contacts(true, best)) return;
    }
  }
  const ConstraintStatistics last = statistics_;
  statistics_ = best.statistics;
  statistics_.iterations = last.iterations;
  statistics_.sweeps = last.sweeps;
  statistics_.newton_steps = last.newton_steps;
  constraints_->restore(best.solution);
  broken_ = std::move(best.broken);
}

Vec3 Simulation::total_momentum() const {
  Vec3 sum = Vec3::Zero();
  for (const Body& body : bodies_)
    if (body.has_inertia()) sum += body.frame().momentum();
  return sum;
}

/// About the origin of the world.
Vec3 Simulation::total_angular_momentum() const {
  Vec3 sum = Vec3::Zero();
  for (const Body& body : bodies_)
    if (body.has_inertia())
      sum += body.frame().translation().cross(body.frame().momentum()) + body.frame().spin();
  return sum;
}

/// Takes the motion as it is now, and what has brought it about.
void Simulation::end_step() {
  Impulses step;
  for (const Body& body : bodies_) step += body.impulses();
  constraints_->add_impulses(step);
  for (Body& body : bodies_) body.end_step();
  momentum_.impulses += step;
  momentum_.scale += step.sum_of_norms();
  momentum_.end = total_momentum();
  momentum_.angular_end = total_angular_momentum();
}

/// Contacts are found anew in every step, but for broken ones.
void Simulation::visit_state(StateArchive& state) {
  state(steps_, statistics_, momentum_, times_);
  state.resizable(broken_);
  for (Body& body : bodies_) {
    state(body);
    state.check(body.frame().step() == steps_);
  }
  state(*constraints_);
}

void Simulation::step() {
  const double start = now();
  constraints_->begin_step(time(), scene_.time_step);
  if (collisions_) collisions_->begin_step(time(), scene_.time_step, broken_);
  begin_step();
  const double solve = now();
  statistics_ = constraints_->solve({});
  times_.unconstrained += solve - start;
  times_.constraints += now() - solve;
  if (collisions_) collide();
  const double correct = now();
  end_step();
  times_.correction += now() - correct;
  ++steps_;
}

}  // namespace bem
