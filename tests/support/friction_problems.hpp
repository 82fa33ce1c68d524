#pragma once

#include "friction/friction_problem.hpp"

namespace bem::test {

/// The problem of a full matrix `w` (3n x 3n); blocks that are zero are left out.
FrictionProblem friction_problem(const Eigen::MatrixXd& w, Eigen::VectorXd q, Eigen::VectorXd mu);

/// Points of an elastic half-space (E = 1, nu = 0.3; Boussinesq and Cerruti, own terms of a disc of
/// the point's share of the area) under a sphere that is pressed down, dragged and turned: points
/// near the centre stick, farther out they slide, at the rim they are open.
FrictionProblem halfspace_problem(int side, double mu_low, double mu_high, double drag,
                                  unsigned seed = 1);

/// Full matrix of a problem.
Eigen::MatrixXd full_matrix(const FrictionProblem& p);

/// Adds an antisymmetric part to W so that |W - W^T| = relative |W|, its entries in proportion to
/// those of W.
void make_unsymmetric(FrictionProblem& p, double relative, unsigned seed = 2);

/// Lowers the least eigenvalue of the symmetric part of W to -relative times the largest one.
void make_indefinite(FrictionProblem& p, double relative);

/// W = A A^T / columns with random A (3n x `columns`; its rank if that is less than 3n) and random
/// q within the range of W, or everywhere if W is regular.
FrictionProblem random_problem(int n, int columns, double mu_low, double mu_high, unsigned seed);

/// Boxes on each other with k x k contacts per face, pushed sideways by `push` times their weight
/// and rocked at random: hyperstatic, W has the rank 6 times the number of boxes at most.
FrictionProblem stack_problem(int boxes, int k, double mu, double push, unsigned seed = 1);

/// A wall of bricks, each on two of the course below (the lowest on the ground).
FrictionProblem wall_problem(int courses, int length, double mu, double push, unsigned seed = 1);

}  // namespace bem::test
