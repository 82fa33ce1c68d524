#include "friction/gauss_seidel.hpp"

#include "base/interruption.hpp"
#include "friction/natural_map.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

const Mat3& own_block(const FrictionProblem& p, int i) {
  const auto begin = p.columns.begin() + p.row_start[i],
             end = p.columns.begin() + p.row_start[i + 1];
  return p.blocks[std::lower_bound(begin, end, i) - p.columns.begin()];
}

/// Sweeps until the change falls to a tenth of the first one.
template <class Sweep>
int solve_stage(int max_sweeps, const Sweep& sweep) {
  const double first = sweep();
  int done = 1;
  if (first > 0)
    while (done < max_sweeps && sweep() > 0.1 * first) ++done;
  return done;
}

}  // namespace

GaussSeidel::GaussSeidel(const ContactSet& set) : set_(set) {
  const FrictionProblem& p = set.problem;
  for (int i = 0; i < p.contacts(); ++i) {
    own_.push_back(own_block(p, i));
    contacts_.emplace_back(own_.back(), p.mu[i], set.scale[i]);
  }
}

double GaussSeidel::sweep(Eigen::VectorXd& forces) const {
  check_interruption();
  const FrictionProblem& p = set_.problem;
  double sum = 0;
  for (int i = 0; i < p.contacts(); ++i) {
    const Vec3 old = forces.segment<3>(3 * i);
    const Vec3 u = displacement(p, i, forces);
    sum += (set_.scale[i] * natural_map(old, u, p.mu[i], set_.scale[i])).squaredNorm();
    forces.segment<3>(3 * i) = contacts_[i].solve(u - own_[i] * old, old);
  }
  return std::sqrt(sum);
}

StaggeredProjections::StaggeredProjections(const ContactSet& set) : set_(set) {
  const FrictionProblem& p = set.problem;
  for (int i = 0; i < p.contacts(); ++i) {
    const Mat3& w = own_block(p, i);
    const double normal = w(0, 0);
    const double tangential =
        0.5 * (w(1, 1) + w(2, 2)) + 0.5 * std::hypot(w(1, 1) - w(2, 2), w(1, 2) + w(2, 1));
    normal_step_.push_back(1 / (normal > 0 ? normal : set.scale[i]));
    friction_step_.push_back(1 / (tangential > 0 ? tangential : set.scale[i]));
  }
}

double StaggeredProjections::normal_sweep(Eigen::VectorXd& forces) const {
  check_interruption();
  double sum = 0;
  for (int i = 0; i < set_.problem.contacts(); ++i) {
    const double old = forces[3 * i];
    const double u = displacement(set_.problem, i, forces)[0];
    forces[3 * i] = std::max(0.0, old - normal_step_[i] * u);
    const double change = set_.scale[i] * (forces[3 * i] - old);
    sum += change * change;
  }
  return std::sqrt(sum);
}

double StaggeredProjections::friction_sweep(Eigen::VectorXd& forces) const {
  check_interruption();
  double sum = 0;
  for (int i = 0; i < set_.problem.contacts(); ++i) {
    const Eigen::Vector2d old = forces.segment<2>(3 * i + 1);
    const Eigen::Vector2d u = displacement(set_.problem, i, forces).tail<2>();
    Eigen::Vector2d r = old - friction_step_[i] * u;
    const double bound = set_.problem.mu[i] * forces[3 * i], length = r.norm();
    if (length > bound) r *= bound / length;
    forces.segment<2>(3 * i + 1) = r;
    sum += set_.scale[i] * set_.scale[i] * (r - old).squaredNorm();
  }
  return std::sqrt(sum);
}

int StaggeredProjections::pass(Eigen::VectorXd& forces, int max_sweeps) const {
  const int normal = solve_stage(max_sweeps, [&] { return normal_sweep(forces); });
  return normal + solve_stage(max_sweeps, [&] { return friction_sweep(forces); });
}

}  // namespace bem
