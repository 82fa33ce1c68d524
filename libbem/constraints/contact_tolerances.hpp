#pragma once

#include "collision/contact.hpp"

namespace bem {

/// When joints and contacts of a scene count as met, deep or near, and how long a step works on
/// them. Every length is derived once, from the contact tolerance of the scene and the size of its
/// smallest body; the folder takes all such numbers from here.
struct ContactTolerances {
  /// `tolerance`: error of a contact's gap and slip that counts as met [m]. `smallest_body`: the
  /// largest distance between two points of the smallest body [m].
  ContactTolerances(double tolerance, double smallest_body);

  double tolerance;  ///< as given [m]

  /// What collision detection looks for [m].
  ContactLimits detection;
  /// Distance of either layer of a sheet from the sheet [m]: more than contacts may miss, so that
  /// it is always clear on which side of the sheet a vertex is.
  double sheet_offset;

  /// The search for the contacts of a step: passes of detection and solution (ContactSearch).
  struct Search {
    double first_error;  ///< to which what touches at the start of the step is solved for [m]
    /// Error of the contacts that may be left in a finished step [m]: those of all steps add up to
    /// a creep.
    double last_error;
    /// Penetration above which a step is tried again without friction at first [m].
    double deep;
    int strict_passes = 8;    ///< so many passes go on for any penetration above the tolerance,
    double late_penetration;  ///< later ones only for a penetration above this [m]
    int most_passes = 12;
    int most_infeasible_passes = 3;  ///< where no forces keep all contacts apart
    int all_views_from = 4;  ///< pass from which contacts are kept as they were seen before, too
    /// Error of a solution after which detection goes on, over the penetration found before it.
    double inexactness = 0.02;
    int most_replacements = 2;  ///< of a known contact by another one of the same vertex or edge
    int most_views = 3;         ///< that are kept of a contact besides the last one
  };
  Search search;
  /// Penetration with which the search may end after some passes [m].
  double penetration_allowed(int passes) const {
    return passes < search.strict_passes ? tolerance : search.late_penetration;
  }

  /// The iteration for the forces of a set of contacts (ConstraintSolver).
  struct Iteration {
    double goal;                  ///< error of the contacts at which it ends [m]
    int most_steps = 40;          ///< solutions of a linearised problem
    int patience = 6;             ///< steps without progress after which it ends
    int patience_infeasible = 1;  ///< the same where no forces keep all contacts apart
    double progress = 0.9;  ///< share of the least error so far below which a step is progress
    /// Share of the error of the step before above which the linearised problem is made anew, and
    /// above which the matrices of the joints are, too.
    double slow = 0.1, very_slow = 0.5;
    /// The error of a step may rise to the largest of so many before it.
    std::size_t memory = 3;
    int most_halvings = 4;  ///< of a step that leads above that
    double most_turn = 3;   ///< of a body by the contact forces that are tried in a step [rad]
    double shortest_step = 1e-9;  ///< to which steps are shortened for the sake of `most_turn`
    /// Where no forces keep all contacts apart, the last motion is taken unless its error is so
    /// many times that of the best one: it shares the penetration out among the contacts.
    double as_good = 1.1;

    /// Errors of the linearised problem: aimed at, over the error of the step's start and over the
    /// goal; not worth the slow methods, over the former and over what is aimed at.
    double inexactness = 0.01, share_of_goal = 0.1, sufficient = 0.1, sufficient_times = 3;
    /// The same relative to the displacements without contact forces: rounding, hard problems.
    double relative = 1e-13, relative_sufficient = 1e-8;

    /// Linear solves and Gauss-Seidel sweeps of all iterations of a step; after them the best
    /// motion found is taken.
    static constexpr int most_solves = 20'000, most_sweeps = 200'000;
  };
  Iteration iteration;

  /// The iteration for the forces of joints alone.
  struct JointIteration {
    int most_steps = 100;
    int patience = 8;       ///< steps after which a slow iteration gets new matrices
    double slow = 0.5;      ///< share of the error of the step before that is slow
    double stalled = 0.95;  ///< the same where rounding has ended the progress
    double still = 1e-12;   ///< change of the rotations that is none [rad]
    /// Error of a joint that counts as met, over the extent of its bodies: where nothing touches,
    /// and where contacts are met to their own, coarser tolerance.
    double met = 1e-11, met_with_contacts = 1e-9;
  };
  JointIteration joints;
};

}  // namespace bem
