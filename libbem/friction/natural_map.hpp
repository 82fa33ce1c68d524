#pragma once

#include "friction/friction_problem.hpp"

namespace bem {

/// Projection onto the friction cone {|r_t| <= mu r_n}.
Vec3 project_cone(const Vec3& r, double mu);

/// r - P_K(r - (u + mu |u_t| n) / scale), zero exactly where the contact law holds [N].
Vec3 natural_map(const Vec3& r, const Vec3& u, double mu, double scale);

/// u = W r + q of one contact.
Vec3 displacement(const FrictionProblem& problem, int contact, const Eigen::VectorXd& forces);

/// |scale_i natural_map_i| over all contacts, in the unit of q.
double natural_map_norm(const FrictionProblem& problem, const Eigen::VectorXd& scale,
                        const Eigen::VectorXd& forces);

}  // namespace bem
