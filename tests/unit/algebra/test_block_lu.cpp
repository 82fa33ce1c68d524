#include "algebra/block_lu.hpp"
#include "base/error.hpp"
#include "files/state_file.hpp"
#include "support/temporary_folder.hpp"
#include "support/uniform.hpp"

#include <numeric>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

const std::vector<int> kSizes = {120, 6, 110, 9};  // with large and with small pivots
const std::vector<std::vector<int>> kChain = {{0, 2}, {1, 3}, {0, 2, 3}, {1, 2, 3}};

/// Fills the blocks of a chain and returns the whole matrix.
Eigen::MatrixXd fill(BlockLu& lu) {
  std::vector<int> begin(kSizes.size() + 1, 0);
  std::partial_sum(kSizes.begin(), kSizes.end(), begin.begin() + 1);
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(begin.back(), begin.back());
  test::Uniform uniform(5);
  for (int i = 0; i < 4; ++i)
    for (int j : kChain[i]) {
      DenseMatrix<double>& block = lu.block(i, j);
      for (double& value : block.reshaped()) value = uniform();
      if (i == j) block.diagonal().array() += 20;
      whole.block(begin[i], begin[j], kSizes[i], kSizes[j]) = block;
    }
  return whole;
}

}  // namespace

TEST_CASE("a chain of dense blocks is solved for one and for several columns") {
  BlockLu lu(kSizes, kChain);
  const Eigen::MatrixXd whole = fill(lu);
  REQUIRE(lu.factorise());
  const Eigen::MatrixXd right = Eigen::MatrixXd::Random(whole.rows(), 3);
  Eigen::MatrixXd several = right;
  lu.solve(several);
  CHECK((whole * several - right).norm() < 1e-12 * right.norm());
  Eigen::VectorXd one = right.col(1);
  lu.solve(one);
  CHECK((one - several.col(1)).norm() < 1e-13 * one.norm());
}

TEST_CASE("factors of blocks are saved and restored to the bit, and refused by other sizes") {
  const test::TemporaryFolder folder("block_lu");
  BlockLu saved(kSizes, kChain);
  const Eigen::MatrixXd whole = fill(saved);
  REQUIRE(saved.factorise());
  {
    StateWriter writer(folder / "state");
    writer(saved);
    writer.commit();
  }
  BlockLu restored(kSizes, kChain);
  StateReader reader(folder / "state");
  reader(restored);
  Eigen::VectorXd a = Eigen::VectorXd::LinSpaced(whole.rows(), -1, 2), b = a;
  saved.solve(a);
  restored.solve(b);
  CHECK(a == b);

  std::vector<int> other = kSizes;
  ++other[1];
  BlockLu wrong(other, kChain);
  StateReader again(folder / "state");
  CHECK_THROWS_AS(again(wrong), Error);
}
