#pragma once

#include "options.hpp"
#include "preparation/body_plan.hpp"

namespace bem {

/// What is going to be computed, and what it will take.
struct Plan {
  BodyInputs inputs;
  BodyPlan body;
  /// Bytes of the matrices, of the working set at most, and of the archive. What compression will
  /// leave is estimated for a dry run only, and zero otherwise.
  double stored = 0, peak = 0, archive_bytes = 0;
  bool uncompressed = false;       ///< those of a dry run that would have to compress for too long
  double compression_seconds = 0;  ///< of assembly and compression, if that was estimated
};

/// Reads and checks mesh and material. Throws as read_material() and plan_body().
Plan make_plan(const Options& options);

/// Throws ErrorCode::resources if the memory is more than the machine has.
void check_memory(const Plan& plan);

/// Expected duration by phase [s], from timing a few rows, a small inversion and a product on this
/// machine (takes about a second).
struct TimeEstimate {
  double assembly = 0, inversion = 0, growth = 0, writing = 0;
  double total() const { return assembly + inversion + growth + writing; }
};
TimeEstimate estimate_time(const Plan& plan);

}  // namespace bem
