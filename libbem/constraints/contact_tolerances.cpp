#include "constraints/contact_tolerances.hpp"

#include <algorithm>

namespace bem {

ContactTolerances::ContactTolerances(double given, double smallest_body)
    : tolerance(given), sheet_offset(std::max(5e-5 * smallest_body, 2 * tolerance)) {
  detection.tolerance = tolerance;
  detection.margin = std::max(1e-3 * smallest_body, 2 * tolerance);
  detection.recovery_depth = std::max(5e-3 * smallest_body, 2 * tolerance);
  search.first_error = 1e-4 * smallest_body;
  search.last_error = 0.1 * tolerance;
  search.deep = 5e-4 * smallest_body;
  search.late_penetration = std::max(2e-5 * smallest_body, tolerance);
  iteration.goal = 0.05 * tolerance;
}

}  // namespace bem
