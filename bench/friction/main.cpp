#include "base/error.hpp"
#include "contact/friction_solver.hpp"
#include "problem_file.hpp"
#include "support/friction_problems.hpp"

#include <cstdio>
#include <ctime>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

using namespace bem;

namespace {

struct Named {
  std::string name;
  FrictionProblem problem;
};

double cpu_milliseconds() {
  return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

FrictionProblem unsymmetric(FrictionProblem problem, double asymmetry, double indefinite) {
  test::make_unsymmetric(problem, asymmetry);
  if (indefinite > 0) test::make_indefinite(problem, indefinite);
  return problem;
}

std::vector<Named> generated_problems() {
  using namespace bem::test;
  std::vector<Named> list;
  for (int side : {10, 18}) {
    list.push_back({"half-space, mu 0.2-0.8", halfspace_problem(side, 0.2, 0.8, 0.5)});
    list.push_back({"half-space, mu 0-1.5", halfspace_problem(side, 0, 1.5, 1)});
    list.push_back({"same, asymmetry 0.07, indefinite 1e-4",
                    unsymmetric(halfspace_problem(side, 0, 1.5, 1), 0.07, 1e-4)});
    list.push_back({"same, asymmetry 0.3, indefinite 1e-4",
                    unsymmetric(halfspace_problem(side, 0, 1.5, 1), 0.3, 1e-4)});
  }
  list.push_back({"table, 20 x 20 legs", stack_problem(1, 20, 0.3, 0.5)});
  list.push_back({"stack of 10, mu 0.5", stack_problem(10, 3, 0.5, 0.3)});
  list.push_back({"stack of 40, mu 0.1", stack_problem(40, 3, 0.1, 0.3)});
  list.push_back({"stack of 40, mu 0.5", stack_problem(40, 3, 0.5, 0.3)});
  list.push_back({"wall, 4 courses, mu 0.2", wall_problem(4, 5, 0.2, 0.3)});
  list.push_back({"wall, 10 courses, mu 0.6", wall_problem(10, 14, 0.6, 0.3)});
  list.push_back({"random, rank 300 of 600", random_problem(200, 300, 0, 1.5, 1)});
  return list;
}

void run(const Named& named, FrictionMethod method, const char* method_name,
         FrictionOptions options) {
  const FrictionProblem& problem = named.problem;
  options.method = method;
  Eigen::VectorXd forces;
  FrictionResult result;
  double least = 1e300, total = 0;
  for (int repeat = 0; repeat < 20 && total < 50; ++repeat) {
    forces = Eigen::VectorXd::Zero(problem.q.size());
    const double start = cpu_milliseconds();
    result = solve_friction(problem, forces, options);
    const double spent = cpu_milliseconds() - start;
    least = std::min(least, spent);
    total += spent;
  }
  std::printf("| %-38.38s | %5d | %-9s | %6d | %4d | %.1e | %.1e | %9.1f | %s |\n",
              named.name.c_str(), problem.contacts(), method_name, result.sweeps,
              result.newton_steps, result.error, unscaled_friction_error(problem, forces), least,
              result.converged ? "yes" : "no");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Errors and CPU times of the frictional contact methods"};
  std::vector<std::string> files;
  bool generated = false;
  FrictionOptions options;
  app.add_option("FILES", files, "problems (HDF5: /W in compressed columns, /q, /mu)");
  app.add_flag("--generated", generated, "solve generated problems");
  app.add_option("--tolerance", options.tolerance, "of the error")->capture_default_str();
  app.add_option("--sweeps", options.max_sweeps, "Gauss-Seidel sweeps")->capture_default_str();
  app.add_option("--steps", options.max_newton_steps, "Newton steps")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    std::vector<Named> problems;
    if (generated || files.empty()) problems = generated_problems();
    for (const std::string& file : files)
      problems.push_back({file.substr(file.rfind('/') + 1), read_friction_problem(file)});
    std::printf(
        "| problem | contacts | method | sweeps | steps | error | unscaled | CPU ms | solved |\n");
    std::printf("|---|---|---|---|---|---|---|---|---|\n");
    for (const Named& problem : problems) {
      run(problem, FrictionMethod::staggered, "staggered", options);
      run(problem, FrictionMethod::nsgs, "nsgs", options);
      run(problem, FrictionMethod::newton, "newton", options);
    }
  } catch (const Error& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
