#include "constraints/contact_search.hpp"

#include <algorithm>

namespace bem {

ContactSearch::ContactSearch(CollisionScene& collisions, ConstraintSolver& solver,
                             std::vector<Body>& bodies, const ContactTolerances& tolerances)
    : collisions_(collisions),
      solver_(solver),
      bodies_(bodies),
      tolerances_(tolerances),
      known_(tolerances) {}

/// Solves for the known contacts, and adds up what it takes.
void ContactSearch::solve(double error, PhaseTimes& times) {
  const PhaseStopwatch timer(times.constraints);
  const ConstraintStatistics last = statistics_;
  statistics_ = solver_.solve(known_.pairs(), error);
  statistics_.add_work(last);
}

/// Starts from what touches at the start of the step.
void ContactSearch::start(bool friction, PhaseTimes& times) {
  known_.clear();
  std::vector<ContactPair> touching;
  {
    const PhaseStopwatch timer(times.collision);
    touching = collisions_.detect_at_rest();
  }
  known_.take(touching, {tolerances_.tolerance, 0, false, friction});
  if (!known_.empty()) solve(tolerances_.search.first_error, times);
}

/// Adds contacts until the motion that they lead to breaks no others; returns whether it came to
/// that. The best motion met goes to `best`.
bool ContactSearch::find(bool friction, Attempt& best, PhaseTimes& times) {
  const ContactTolerances::Search& t = tolerances_.search;
  bool exact = false;
  for (int pass = 0;; ++pass) {
    std::vector<ContactPair> found;
    {
      const PhaseStopwatch timer(times.collision);
      found = collisions_.detect(bodies_);
    }
    const double allowed = tolerances_.penetration_allowed(pass);
    const KnownContacts::Finding now = KnownContacts::judge(found, -allowed);
    statistics_.contacts_complete = now.broken.empty();
    statistics_.penetration = now.deepest;
    statistics_.contacts_met = statistics_.contacts_met && friction;
    if (now.deepest < best.penetration)
      best = {now.deepest, statistics_, solver_.solution(), now.broken};
    if (now.broken.empty() && (exact || statistics_.contact_residual <= t.last_error)) return true;
    const bool hopeless = statistics_.infeasible && pass >= t.most_infeasible_passes;
    if (pass == t.most_passes || hopeless || statistics_.exhausted) return false;
    if (!now.broken.empty())
      known_.take(found, {-tolerances_.tolerance, -allowed, pass >= t.all_views_from, friction});
    exact = now.broken.empty();
    solve(exact ? 0 : t.inexactness * now.deepest, times);
  }
}

ConstraintStatistics ContactSearch::run(const ConstraintStatistics& joints, PhaseTimes& times) {
  statistics_ = joints;
  broken_.clear();
  Attempt best;
  start(true, times);
  if (find(true, best, times)) return statistics_;
  const bool hopeless = best.statistics.infeasible || statistics_.exhausted;
  if (best.penetration > tolerances_.search.deep && !hopeless) {
    start(false, times);
    if (find(false, best, times)) {
      known_.restore_friction();
      solve(0, times);
      if (find(true, best, times)) return statistics_;
    }
  }
  solver_.restore(best.solution);
  broken_ = std::move(best.broken);
  return best.statistics.with_work_of(statistics_);
}

}  // namespace bem
