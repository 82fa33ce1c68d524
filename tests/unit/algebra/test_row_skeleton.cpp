#include "algebra/row_skeleton.hpp"

#include <catch2/catch.hpp>

using namespace bem;

namespace {

/// 1/(2 + x - y) of two intervals.
Eigen::MatrixXd smooth_kernel(int rows, int columns) {
  Eigen::MatrixXd a(rows, columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      a(i, j) = 1 / (2 + i / static_cast<double>(rows) - j / static_cast<double>(columns));
  return a;
}

}  // namespace

TEST_CASE("few rows of a smooth kernel stand for all of them") {
  const Eigen::MatrixXd a = smooth_kernel(90, 70);
  int last_size = 0;
  for (double cut : {1e-4, 1e-8, 1e-14}) {
    const RowSkeleton skeleton(a, cut);
    CHECK(skeleton.size() > last_size);
    CHECK(skeleton.size() < 25);
    last_size = skeleton.size();
    const Eigen::MatrixXd weights = skeleton.in_skeleton(skeleton.coefficients);
    const Eigen::MatrixXd rest = a - weights * a(skeleton.rows, Eigen::all);
    CHECK(rest.squaredNorm() < 30 * cut);
    // rows of the skeleton stand for themselves
    CHECK((weights(skeleton.rows, Eigen::all) -
           Eigen::MatrixXd::Identity(skeleton.size(), skeleton.size()))
              .cwiseAbs()
              .maxCoeff() < 1e-9);
  }
}

TEST_CASE("a skeleton has no more rows than the rank, and none of zeros") {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(12, 3) * Eigen::MatrixXd::Random(3, 40);
  CHECK(RowSkeleton(a, 1e-26 * a.squaredNorm()).size() == 3);
  CHECK(RowSkeleton(Eigen::MatrixXd::Zero(5, 4), 0).size() == 0);
  const RowSkeleton none(Eigen::MatrixXd(5, 0), 0);
  CHECK(none.in_skeleton(none.coefficients).size() == 0);
}
