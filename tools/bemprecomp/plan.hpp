#pragma once

#include "options.hpp"
#include "preparation/body_plan.hpp"

namespace bem {

/// What is going to be computed, and what it will take.
struct Plan {
  BodyInputs inputs;
  BodyPlan body;
  double stored = 0, peak = 0;  ///< bytes of the matrices, and of the working set at most
  double archive_bytes = 0;
};

/// Reads and checks mesh and material. Throws as read_material() and plan_body().
Plan make_plan(const Options& options);

}  // namespace bem
