#include "friction/natural_map.hpp"

#include <cmath>

namespace bem {

Vec3 project_cone(const Vec3& r, double mu) {
  const double t = std::hypot(r[1], r[2]);
  if (t <= mu * r[0]) return r;
  if (mu * t <= -r[0]) return Vec3::Zero();
  const double n = (r[0] + mu * t) / (1 + mu * mu);
  const double shrink = t > 0 ? mu * n / t : 0;
  return {n, shrink * r[1], shrink * r[2]};
}

Vec3 natural_map(const Vec3& r, const Vec3& u, double mu, double scale) {
  Vec3 step = u / scale;
  step[0] += mu * std::hypot(step[1], step[2]);
  return r - project_cone(r - step, mu);
}

Vec3 displacement(const FrictionProblem& problem, int contact, const Eigen::VectorXd& forces) {
  Vec3 u = problem.q.segment<3>(3 * contact);
  for (int k = problem.row_start[contact]; k < problem.row_start[contact + 1]; ++k)
    u.noalias() += problem.blocks[k] * forces.segment<3>(3 * problem.columns[k]);
  return u;
}

double natural_map_norm(const FrictionProblem& problem, const Eigen::VectorXd& scale,
                        const Eigen::VectorXd& forces) {
  double sum = 0;
  for (int i = 0; i < problem.contacts(); ++i)
    sum += (scale[i] * natural_map(forces.segment<3>(3 * i), displacement(problem, i, forces),
                                   problem.mu[i], scale[i]))
               .squaredNorm();
  return std::sqrt(sum);
}

}  // namespace bem
