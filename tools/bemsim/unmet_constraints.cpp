#include "unmet_constraints.hpp"

#include "mesh/describe.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace bem {
namespace {

/// A length with as many digits as an error has.
std::string length_text(double value) {
  return rounded_text(value, 2) + " m";
}

std::string steps_text(long steps) {
  return "in " + count_text(static_cast<std::size_t>(steps), "step");
}

}  // namespace

void UnmetConstraints::Kind::add(double miss) {
  ++steps;
  worst = std::max(worst, miss);
}

std::optional<std::string> UnmetConstraints::record(const Simulation& simulation) {
  const ConstraintStatistics& s = simulation.statistics();
  if (s.converged()) return std::nullopt;
  if (!s.joints_met) joints_.add(s.joint_residual);
  if (!s.contacts_met && !s.infeasible) contacts_.add(s.contact_residual);
  if (!s.contacts_complete) penetrations_.add(s.penetration);
  infeasible_ += s.infeasible;
  exhausted_ += s.exhausted;
  if (++steps_ > 1) return std::nullopt;
  first_ = simulation.time();
  return "the constraints of the step to t = " + to_text(first_) +
         " s were not met: joints miss by up to " + length_text(s.joint_residual) +
         ", contact displacements are wrong by up to " + length_text(s.contact_residual) +
         ", penetration is up to " + length_text(s.penetration);
}

std::optional<std::string> UnmetConstraints::warning(long steps, const ContactSpec& contact,
                                                     const std::string& impossible) const {
  if (steps_ == 0) return std::nullopt;
  std::string text = "the constraints were not met in " + std::to_string(steps_) + " of " +
                     count_text(static_cast<std::size_t>(steps), "step") +
                     ", first at t = " + to_text(first_) + " s: ";
  std::string separator;
  const auto add = [&](const Kind& kind, const std::string& what, const std::string& cure) {
    if (kind.steps == 0) return;
    text += separator + what + " by up to " + length_text(kind.worst) + " " +
            steps_text(kind.steps) + " (" + cure + ")";
    separator = "; ";
  };
  const std::string tolerance = "the contact tolerance, " + to_text(contact.tolerance) + " m";
  add(joints_, "joints, fixed vertices or handles missed their places",
      impossible.empty() ? "use a shorter time step, or remove joints that contradict each other"
                         : impossible);
  add(contacts_, "contact displacements were wrong",
      std::string("use a shorter time step, ") +
          (contact.solver == FrictionMethod::newton ? "" : "the contact solver \"newton\", ") +
          "or raise " + tolerance);
  add(penetrations_, "bodies still penetrated each other or obstacles",
      infeasible_ > 0 ? steps_text(infeasible_) +
                            " nothing could keep them apart: something rigid was squeezed between "
                            "things that do not give way; make room for it, or make it deformable"
                      : "use a shorter time step, or raise " + tolerance);
  if (exhausted_ > 0)
    text += "; " + steps_text(exhausted_) + " the work allowed for a step (" +
            std::to_string(ContactTolerances::Iteration::most_solves) +
            " linear solves) ended the search for contact forces";
  return text;
}

nlohmann::ordered_json UnmetConstraints::json() const {
  return {{"joints", joints_.steps},
          {"contacts", contacts_.steps},
          {"penetration", penetrations_.steps},
          {"infeasible", infeasible_},
          {"exhausted", exhausted_}};
}

}  // namespace bem
