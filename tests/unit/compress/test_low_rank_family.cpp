#include "base/parallel.hpp"
#include "compress/low_rank_builder.hpp"
#include "mesh/shapes.hpp"
#include "support/matrix_examples.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

struct LowRankExample : MatrixExample {
  explicit LowRankExample(int subdivisions, double range = 1)
      : MatrixExample(icosphere(subdivisions, 1).vertices, range) {}

  std::unique_ptr<MatrixFamily> compress(double tolerance, double* error = nullptr,
                                         const PartitionOptions& options = {20, 64, 2.0},
                                         MatrixForm form = MatrixForm::general) const {
    const std::vector<Slab> partition = with_form(make_partition(nodes, options), form);
    const Slab& middle = partition[partition.size() / 2];
    LowRankBuilder builder(partition, kMatrices,
                           LowRankBuilder::choose_quantum(middle, {rows_of(middle), nullptr, {}},
                                                          tolerance * norm, true),
                           form);
    for (const Slab& slab : partition) builder.add_rows(rows_of(slab));
    if (error) *error = builder.error();
    return builder.finish();
  }

  std::vector<MatrixView<float>> rows_of(const Slab& slab) const {
    std::vector<MatrixView<float>> rows;
    for (const FloatMatrix& m : matrices)
      rows.emplace_back(m.data() + 3 * slab.row_begin, 3 * (slab.row_end - slab.row_begin),
                        m.cols(), Eigen::OuterStride<>(m.rows()));
    return rows;
  }
};

const LowRankExample& sphere() {
  static const LowRankExample example(3);
  return example;
}

}  // namespace

TEST_CASE("large blocks in which nothing counts, a little, or much meet the tolerance") {
  for (const double range : {1.0, 8.0, 60.0}) {
    const LowRankExample example(3, range);
    for (const double tolerance : {1e-2, 1e-4, 1e-5}) {
      CAPTURE(range, tolerance);
      double claimed = 0;
      const auto family = example.compress(tolerance, &claimed, {});
      const double error = example.error_of(*family);
      CHECK(error < 2 * tolerance);
      CHECK(error == Approx(claimed).epsilon(0.3));
    }
  }
}

TEST_CASE("the error of the matrices is about the tolerance, and the builder knows it") {
  std::size_t last = 0;
  for (double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
    double reported = 0;
    const auto family = sphere().compress(tolerance, &reported);
    const double error = sphere().error_of(*family);
    CAPTURE(tolerance, error, reported, family->bytes());
    CHECK(error < 1.5 * tolerance);
    CHECK(error > 0.5 * tolerance);
    CHECK(reported == Approx(error).epsilon(0.05));
    CHECK(family->bytes() > last);
    last = family->bytes();
  }
  const std::size_t dense = 4 * kMatrices * sphere().matrices[0].size();
  CHECK(sphere().compress(1e-4)->bytes() < dense / 4);
}

TEST_CASE("products, sparse, transposed and left products agree with the entries") {
  const MatrixForm form = GENERATE(MatrixForm::general, MatrixForm::symmetric);
  const auto family = sphere().compress(1e-3, nullptr, {20, 64, 2.0}, form);
  const auto n = static_cast<Eigen::Index>(family->rows());
  std::vector<Eigen::MatrixXd> full;
  for (int k = 0; k < kMatrices; ++k) full.push_back(full_matrix(*family, k));
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(n, 2 * kMatrices);

  Eigen::MatrixXd expected = Eigen::MatrixXd::Ones(n, 2);
  for (int c = 0; c < 2 * kMatrices; ++c)
    expected.col(c % 2) += 0.5 * full[c % kMatrices] * x.col(c);
  CHECK((products(*family, x, 2) - expected).norm() < 3e-6 * expected.norm());

  const std::vector<int> columns = {0, 4, 5, 700, static_cast<int>(n) - 1};
  const Eigen::VectorXd values = Eigen::VectorXd::Random(5);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
  family->multiply_add(std::vector<SparseTerm>{{1, &columns, values.data(), 0, 2.0}}, {y.data()});
  const Eigen::VectorXd sparse = 2 * full[1](Eigen::all, columns) * values;
  CHECK((y - sparse).norm() < 3e-6 * sparse.norm());

  y.setZero();
  family->multiply_transposed_add(
      {{0, x.col(0).data(), nullptr, 0, 1.0}, {2, x.col(1).data(), nullptr, 0, -3.0}}, {y.data()});
  const Eigen::VectorXd transposed =
      full[0].transpose() * x.col(0) - 3 * full[2].transpose() * x.col(1);
  CHECK((y - transposed).norm() < 3e-6 * transposed.norm());

  if (form == MatrixForm::symmetric) return;
  const FloatMatrix left = FloatMatrix::Random(150, n);
  const Eigen::MatrixXd right =
      dynamic_cast<const LowRankFamily&>(*family).multiply_left(left, 0).cast<double>();
  CHECK((right - left.cast<double>() * full[0]).norm() < 3e-6 * right.norm());
}

TEST_CASE("symmetric matrices take not much more than half, with the same error") {
  const auto general = sphere().compress(1e-4);
  double claimed = 0;
  const auto family = sphere().compress(1e-4, &claimed, {20, 64, 2.0}, MatrixForm::symmetric);
  CHECK(static_cast<double>(family->bytes()) < 0.6 * static_cast<double>(general->bytes()));
  CHECK(sphere().error_of(*family) == Approx(claimed).epsilon(0.05));
  CHECK(claimed == Approx(sphere().error_of(*general)).epsilon(0.1));
  for (int k = 0; k < kMatrices; ++k) {
    const Eigen::MatrixXd full = full_matrix(*family, k);
    CHECK((full - full.transpose()).norm() < 2e-4 * full.norm());  // rounding of own blocks
  }
}

TEST_CASE("sums of matrices and blocks of them") {
  const MatrixForm form = GENERATE(MatrixForm::general, MatrixForm::symmetric);
  const auto family = sphere().compress(1e-3, nullptr, {20, 64, 2.0}, form);
  const auto sums = family->combine({{1, 1, 1}, {0, 2, -1}});
  REQUIRE(sums->count() == 2);
  const Eigen::MatrixXd all =
      full_matrix(*family, 0) + full_matrix(*family, 1) + full_matrix(*family, 2);
  CHECK((full_matrix(*sums, 0) - all).norm() < 1e-6 * all.norm());
  const Eigen::MatrixXd other = 2 * full_matrix(*family, 1) - full_matrix(*family, 2);
  CHECK((full_matrix(*sums, 1) - other).norm() < 1e-6 * other.norm());
  const std::vector<int> rows = {900, 3, 4, 31}, columns = {1900, 2, 900};
  const Eigen::MatrixXd expected = full_matrix(*family, 1)(rows, columns);
  CHECK((family->block(1, rows, columns) - expected).norm() < 1e-6 * expected.norm());
}

TEST_CASE("compression and products are bit-identical for any number of threads") {
  const MatrixForm form = GENERATE(MatrixForm::general, MatrixForm::symmetric);
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(3 * sphere().nodes.size(), kMatrices);
  std::vector<Eigen::MatrixXd> results;
  std::vector<std::vector<std::uint8_t>> bytes;
  for (int threads : {1, 2, 5}) {
    set_thread_count(threads);
    const auto family = sphere().compress(1e-4, nullptr, {20, 64, 2.0}, form);
    results.push_back(products(*family, x, 1));
    bytes.push_back(dynamic_cast<const LowRankFamily&>(*family).slabs()[2].synthesis);
  }
  CHECK(results[0] == results[1]);
  CHECK(results[0] == results[2]);
  CHECK(bytes[0] == bytes[1]);
  CHECK(bytes[0] == bytes[2]);
}

TEST_CASE("tiny bodies and vanishing matrices are compressed, too") {
  const LowRankExample tetrahedron(0);
  const auto family = tetrahedron.compress(1e-4);
  CHECK(tetrahedron.error_of(*family) < 3e-4);
  LowRankBuilder builder(make_partition(tetrahedron.nodes, {}), 1, 1e-6, MatrixForm::general);
  const FloatMatrix zeros = FloatMatrix::Zero(36, 36);
  builder.add_rows({MatrixView<float>(zeros.data(), 36, 36, Eigen::OuterStride<>(36))});
  const auto nothing = builder.finish();
  CHECK(nothing->bytes() == 0);
  CHECK(full_matrix(*nothing, 0).isZero(0));
}
