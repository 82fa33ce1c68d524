#include "support/friction_problems.hpp"

#include "algebra/decompositions.hpp"
#include "base/error.hpp"
#include "support/rigid_scene.hpp"
#include "support/uniform.hpp"

#include <cmath>
#include <vector>

namespace bem::test {

FrictionProblem friction_problem(const Eigen::MatrixXd& w, Eigen::VectorXd q, Eigen::VectorXd mu) {
  FrictionProblem problem;
  const int n = static_cast<int>(mu.size());
  require(w.rows() == 3 * n && w.cols() == 3 * n, "the compliance matrix has 3n rows and columns");
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Mat3 block = w.block<3, 3>(3 * i, 3 * j);
      if (i != j && block.isZero(0)) continue;
      problem.columns.push_back(j);
      problem.blocks.push_back(block);
    }
    problem.row_start.push_back(static_cast<int>(problem.columns.size()));
  }
  problem.q = std::move(q);
  problem.mu = std::move(mu);
  check_problem(problem);
  return problem;
}

FrictionProblem halfspace_problem(int side, double mu_low, double mu_high, double drag,
                                  unsigned seed) {
  const double nu = 0.3, spacing = 1.0 / side, radius = spacing / std::sqrt(kPi);
  const int n = side * side;
  Uniform uniform(seed);
  std::vector<Eigen::Vector2d> x;
  for (int i = 0; i < n; ++i)
    x.emplace_back(spacing * (i % side + 0.5 + 0.2 * uniform()) - 0.5,
                   spacing * (i / side + 0.5 + 0.2 * uniform()) - 0.5);
  Eigen::MatrixXd w(3 * n, 3 * n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      Mat3 block;
      const Eigen::Vector2d d = x[i] - x[j];
      const double r = d.norm(), shear = (1 + nu) / kPi;
      if (i == j) {
        block = Vec3(1 - nu, 1 - nu / 2, 1 - nu / 2).asDiagonal();
        block *= 2 * shear / radius;
      } else {
        block(0, 0) = shear * (1 - nu) / r;
        block.bottomRightCorner<2, 2>() =
            shear / r * ((1 - nu) * Eigen::Matrix2d::Identity() + nu * d * d.transpose() / (r * r));
        const Eigen::Vector2d coupling = 0.5 * shear * (1 - 2 * nu) / (r * r) * d;
        block.block<1, 2>(0, 1) = coupling.transpose();
        block.block<2, 1>(1, 0) = -coupling;
      }
      w.block<3, 3>(3 * i, 3 * j) = block;
    }
  Eigen::VectorXd q(3 * n), mu(n);
  for (int i = 0; i < n; ++i) {
    q.segment<3>(3 * i) << x[i].squaredNorm() - 0.1, 0.1 * drag * (1 - x[i][1]),
        0.1 * drag * (0.2 + x[i][0]);
    mu[i] = uniform.between(mu_low, mu_high);
  }
  return friction_problem(w, q, mu);
}

Eigen::MatrixXd full_matrix(const FrictionProblem& p) {
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(3 * p.contacts(), 3 * p.contacts());
  for (int i = 0; i < p.contacts(); ++i)
    for (int k = p.row_start[i]; k < p.row_start[i + 1]; ++k)
      w.block<3, 3>(3 * i, 3 * p.columns[k]) = p.blocks[k];
  return w;
}

void make_unsymmetric(FrictionProblem& p, double relative, unsigned seed) {
  const Eigen::MatrixXd w = full_matrix(p);
  Uniform uniform(seed);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(w.rows(), w.cols());
  for (Eigen::Index i = 0; i < w.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      a(i, j) = std::abs(w(i, j)) * uniform();
      a(j, i) = -a(i, j);
    }
  p = friction_problem(w + a * (0.5 * relative * w.norm() / a.norm()), p.q, p.mu);
}

void make_indefinite(FrictionProblem& p, double relative) {
  const Eigen::MatrixXd w = full_matrix(p);
  const SymmetricEigensystem eigen = symmetric_eigensystem(0.5 * (w + w.transpose()));
  const Eigen::VectorXd v = eigen.vectors.col(0);
  const double excess = eigen.values[0] + relative * eigen.values[w.rows() - 1];
  p = friction_problem(w - excess * v * v.transpose(), p.q, p.mu);
}

FrictionProblem random_problem(int n, int columns, double mu_low, double mu_high, unsigned seed) {
  Uniform uniform(seed);
  Eigen::MatrixXd a(3 * n, columns);
  for (double& value : a.reshaped()) value = uniform();
  Eigen::VectorXd force(columns), mu(n);
  for (double& value : force) value = uniform();
  for (double& value : mu) value = uniform.between(mu_low, mu_high);
  return friction_problem(a * a.transpose() / columns, a * force, mu);
}

FrictionProblem stack_problem(int boxes, int k, double mu, double push, unsigned seed) {
  RigidScene scene;
  Uniform uniform(seed);
  const double gravity = 9.81e-4;  // times dt^2
  for (int b = 0; b < boxes; ++b) {
    Eigen::Matrix<double, 6, 1> free;
    free << push * gravity, 0.3 * push * gravity * uniform(), -gravity,
        0.2 * push * gravity * uniform(), 0.2 * push * gravity * uniform(),
        0.2 * push * gravity * uniform();
    scene.add_box({0, 0, 0.1 + 0.2 * b}, {0.4, 0.4, 0.2}, uniform.between(1, 3), free);
    scene.add_face(b, b - 1, {0, 0, 0.2 * b}, 0.4, 0.4, k, mu);
  }
  return scene.problem();
}

FrictionProblem wall_problem(int courses, int length, double mu, double push, unsigned seed) {
  RigidScene scene;
  Uniform uniform(seed);
  const double gravity = 9.81e-4;
  std::vector<int> below;
  for (int c = 0; c < courses; ++c) {
    std::vector<int> course;
    const int count = length - c % 2;
    const double start = c % 2 == 0 ? 0 : 0.1;
    for (int b = 0; b < count; ++b) {
      Eigen::Matrix<double, 6, 1> free;
      free << push * gravity * uniform(), push * gravity * uniform(), -gravity,
          push * gravity * uniform(), push * gravity * uniform(), push * gravity * uniform();
      const Vec3 centre(start + 0.2 * b, 0, 0.05 + 0.1 * c);
      course.push_back(scene.add_box(centre, {0.2, 0.1, 0.1}, 2, free));
      for (int half = 0; half < 2; ++half) {
        const int under = b + half - (c % 2 == 0 ? 1 : 0);
        const int other = c == 0 ? RigidScene::kGround : under;
        if (c > 0 && (under < 0 || under >= static_cast<int>(below.size()))) continue;
        scene.add_face(course.back(), c == 0 ? other : below[under],
                       centre + Vec3(half == 0 ? -0.05 : 0.05, 0, -0.05), 0.1, 0.1, 2, mu);
      }
    }
    below = course;
  }
  return scene.problem();
}

}  // namespace bem::test
