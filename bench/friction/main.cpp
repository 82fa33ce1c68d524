#include "base/error.hpp"
#include "friction/contact_set.hpp"
#include "friction/friction_solver.hpp"
#include "friction/natural_map.hpp"
#include "own_scenes.hpp"
#include "problem_file.hpp"
#include "support/friction_problems.hpp"
#ifdef BEM_WITH_SICONOS
#include "siconos.hpp"
#endif

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>

#include <CLI/CLI.hpp>

using namespace bem;

namespace {

double cpu_milliseconds() {
  return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

FrictionProblem unsymmetric(FrictionProblem problem, double asymmetry, double indefinite) {
  test::make_unsymmetric(problem, asymmetry);
  if (indefinite > 0) test::make_indefinite(problem, indefinite);
  return problem;
}

std::vector<NamedProblem> generated_problems() {
  using namespace bem::test;
  std::vector<NamedProblem> list;
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

/// The error that friction_solver.hpp defines, of any forces.
double friction_error(const FrictionProblem& problem, const Eigen::VectorXd& forces) {
  double error = 0;
  for (const ContactSet& set : connected_sets(problem)) {
    Eigen::VectorXd r(3 * set.contacts.size());
    for (std::size_t i = 0; i < set.contacts.size(); ++i)
      r.segment<3>(static_cast<Eigen::Index>(3 * i)) =
          forces.segment<3>(3 * set.contacts[i]) / set.force_unit;
    error = std::max(error, natural_map_norm(set.problem, set.scale, r));
  }
  return error;
}

/// What a solver does from no forces: returns sweeps and linear solves.
using Solver = std::function<std::pair<int, int>(const FrictionProblem&, Eigen::VectorXd&)>;

struct Method {
  std::string name;
  Solver solve;
  int most_contacts = std::numeric_limits<int>::max();  ///< larger problems are left out
};

#ifdef BEM_WITH_SICONOS
constexpr int kSiconosNewtonSteps = 200;         // its default
constexpr int kMostSiconosNewtonContacts = 600;  // larger ones take minutes
#endif

std::vector<Method> methods(const FrictionOptions& options, bool siconos) {
  std::vector<Method> list;
  const auto add = [&](const char* name, FrictionMethod method) {
    FrictionOptions o = options;
    o.method = method;
    list.push_back({name, [o](const FrictionProblem& p, Eigen::VectorXd& forces) {
                      const FrictionResult result = solve_friction(p, forces, o);
                      return std::make_pair(result.sweeps, result.newton_steps);
                    }});
  };
  add("staggered", FrictionMethod::staggered);
  add("nsgs", FrictionMethod::nsgs);
  add("newton", FrictionMethod::newton);
  if (!siconos) return list;
#ifdef BEM_WITH_SICONOS
  list.push_back({"S nsgs", [options](const FrictionProblem& p, Eigen::VectorXd& forces) {
                    return std::make_pair(
                        solve_with_siconos(p, SiconosMethod::nsgs, options.tolerance,
                                           options.max_sweeps, forces),
                        0);
                  }});
  list.push_back({"S nsn_ac",
                  [options](const FrictionProblem& p, Eigen::VectorXd& forces) {
                    return std::make_pair(
                        0, solve_with_siconos(p, SiconosMethod::nsn_ac, options.tolerance,
                                              kSiconosNewtonSteps, forces));
                  },
                  kMostSiconosNewtonContacts});
#else
  throw Error(ErrorCode::usage, "this program was built without Siconos");
#endif
  return list;
}

void run(const NamedProblem& named, const Method& method, double tolerance) {
  const FrictionProblem& problem = named.problem;
  Eigen::VectorXd forces;
  std::pair<int, int> work;
  double least = std::numeric_limits<double>::infinity(), total = 0;
  for (int repeat = 0; repeat < 20 && total < 50; ++repeat) {
    forces = Eigen::VectorXd::Zero(problem.q.size());
    const double start = cpu_milliseconds();
    work = method.solve(problem, forces);
    const double spent = cpu_milliseconds() - start;
    least = std::min(least, spent);
    total += spent;
  }
  const double error = friction_error(problem, forces);
  std::printf("| %-38.38s | %5d | %-9s | %6d | %4d | %.1e | %.1e | %9.1f | %s |\n",
              named.name.c_str(), problem.contacts(), method.name.c_str(), work.first, work.second,
              error, unscaled_friction_error(problem, forces), least,
              error <= tolerance ? "yes" : "no");
  std::fflush(stdout);
}

void save(const std::vector<NamedProblem>& problems, const std::string& folder) {
  std::filesystem::create_directories(folder);
  for (const NamedProblem& p : problems) {
    std::string file = p.name + ".h5";
    for (char& c : file)
      if (c == ' ' || c == ',') c = '-';
    write_friction_problem((std::filesystem::path(folder) / file).string(), p.problem);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Errors and CPU times of the frictional contact methods"};
  std::vector<std::string> files;
  bool generated = false, scenes = false, siconos = false;
  std::string folder;
  FrictionOptions options;
  app.add_option("FILES", files, "problems (HDF5: /W in compressed columns, /q, /mu)");
  app.add_flag("--generated", generated, "solve generated problems");
  app.add_flag("--scenes", scenes, "simulate scenes and solve problems that occur in them");
  app.add_option("--save", folder, "write the problems of the scenes to this folder");
  app.add_flag("--siconos", siconos, "also with the solvers of Siconos, if it was found");
  app.add_option("--tolerance", options.tolerance, "of the error")->capture_default_str();
  app.add_option("--sweeps", options.max_sweeps, "Gauss-Seidel sweeps")->capture_default_str();
  app.add_option("--steps", options.max_newton_steps, "Newton steps")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    const std::vector<Method> list = methods(options, siconos);
    std::printf(
        "| problem | contacts | method | sweeps | steps | error | unscaled | CPU ms | solved |\n");
    std::printf("|---|---|---|---|---|---|---|---|---|\n");
    const auto solve_all = [&](const std::vector<NamedProblem>& problems) {
      for (const NamedProblem& problem : problems)
        for (const Method& method : list)
          if (problem.problem.contacts() <= method.most_contacts)
            run(problem, method, options.tolerance);
    };
    if (generated || (files.empty() && !scenes)) solve_all(generated_problems());
    for (const std::string& file : files)
      solve_all({{file.substr(file.rfind('/') + 1), read_friction_problem(file)}});
    for (int i = 0; scenes && i < own_scene_count(); ++i) {
      OwnScene scene = make_own_scene(i);
      const std::vector<NamedProblem> problems = record_problems(scene, 2);
      if (!folder.empty()) save(problems, folder);
      solve_all(problems);
    }
  } catch (const Error& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
