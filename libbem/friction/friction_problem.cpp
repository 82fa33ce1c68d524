#include "friction/friction_problem.hpp"

#include "base/error.hpp"

namespace bem {

void check_problem(const FrictionProblem& problem) {
  const int n = problem.contacts();
  require(problem.q.size() == 3 * n, "a friction problem has 3n displacements");
  require(problem.row_start.size() == static_cast<std::size_t>(n) + 1 && problem.row_start[0] == 0,
          "a friction problem has n rows");
  require(problem.columns.size() == problem.blocks.size() &&
              static_cast<std::size_t>(problem.row_start[n]) == problem.columns.size(),
          "every block of a friction problem has a column");
  for (int i = 0; i < n; ++i) {
    require(problem.mu[i] >= 0 && std::isfinite(problem.mu[i]),
            "friction coefficients are finite and not negative");
    require(problem.row_start[i] <= problem.row_start[i + 1], "rows are in order");
    bool diagonal = false;
    for (int k = problem.row_start[i]; k < problem.row_start[i + 1]; ++k) {
      const int j = problem.columns[k];
      require(j >= 0 && j < n && (k == problem.row_start[i] || problem.columns[k - 1] < j),
              "the columns of a friction problem are ascending");
      diagonal |= j == i;
    }
    require(diagonal, "every contact of a friction problem has its own block");
  }
}

}  // namespace bem
