#include "simulation/initial_state.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "scene/location.hpp"
#include "simulation/start_joints.hpp"

#include <algorithm>

namespace bem {
namespace {

/// "ball" and "box", or how many there are.
std::string bodies_text(const std::vector<std::string>& names) {
  constexpr std::size_t kNamed = 3;
  if (names.size() > kNamed) return "the " + std::to_string(names.size()) + " bodies";
  std::string out = names.size() == 1 ? "the body " : "the bodies ";
  for (std::size_t i = 0; i < names.size(); ++i)
    out += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + in_quotes(names[i]);
  return out;
}

std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t kListed = 10;
  return quoted_list(names, kListed);
}

}  // namespace

InitialState::InitialState(const Scene& scene) : scene_(scene), spec_(*scene.initial_state) {
  at_place(spec_.file.location, [&] {
    saved_ = spec_.is_checkpoint ? open_checkpoint_bodies(spec_.file.resolved)
                                 : open_trajectory_bodies(spec_.file.resolved, spec_.frame);
  });
  choose_bodies();
}

void InitialState::choose_bodies() {
  std::vector<std::string> names = saved_->names();
  std::sort(names.begin(), names.end());
  const auto is_saved = [&](std::size_t b) {
    return std::binary_search(names.begin(), names.end(), name_of(b));
  };
  bodies_ = spec_.bodies;
  std::sort(bodies_.begin(), bodies_.end());
  for (std::size_t b : bodies_)
    if (!is_saved(b))
      throw error_at(spec_.location, spec_.file.resolved + " has no body " + in_quotes(name_of(b)) +
                                         "; its bodies are " + list_of(names));
  if (!bodies_.empty()) return;
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b)
    if (is_saved(b)) bodies_.push_back(b);
  if (bodies_.empty())
    throw error_at(spec_.location, spec_.file.resolved + " has no body of this scene; " +
                                       (names.empty() ? std::string("it has no bodies")
                                                      : "its bodies are " + list_of(names)));
}

bool InitialState::has(std::size_t body) const {
  return std::binary_search(bodies_.begin(), bodies_.end(), body);
}

void InitialState::check(const std::vector<StartingBody>& bodies) const {
  at_place(spec_.file.location, [&] {
    for (std::size_t b : bodies_) saved_->check(bodies[b]);
  });
}

std::vector<int> InitialState::touched(std::size_t body) const {
  return has(body) ? saved_->touched(name_of(body)) : std::vector<int>();
}

std::string InitialState::moment() const {
  return saved_->moment() + " of " + printable(spec_.file.written);
}

std::string InitialState::text(const std::vector<StartingBody>& bodies) const {
  std::vector<std::string> names;
  for (std::size_t b : bodies_) names.push_back(name_of(b));
  std::string out =
      bodies_text(names) + (names.size() == 1 ? " starts" : " start") + " from " + moment();
  if (spec_.is_checkpoint) return out + ", with the deformation and its past";
  std::optional<double> most;
  std::size_t of = 0;
  at_place(spec_.file.location, [&] {
    for (std::size_t b : bodies_) {
      const std::optional<double> lost = saved_->lost_deformation(bodies[b]);
      if (!lost || (most && *lost <= *most)) continue;
      most = lost;
      of = b;
    }
  });
  out += ", undeformed and without vibrations, of whose past a trajectory knows nothing";
  if (most)
    out += "; displacements of up to " + percent_text(*most) + " of the size" +
           (names.size() == 1 ? "" : " of " + in_quotes(name_of(of))) + " are left out";
  return out;
}

void InitialState::apply(JointPlan& plan, std::vector<Body>& bodies,
                         ConstraintSolver& solver) const {
  at_place(spec_.file.location, [&] {
    for (std::size_t b : bodies_) saved_->start(bodies[b]);
  });
  for (std::size_t b : bodies_) hold_in_place(plan, bodies, b, solver);
  at_place(spec_.location, [&] { check_joined(plan, bodies); });
}

}  // namespace bem
