#include "base/parallel.hpp"
#include "compress/dense_store.hpp"

#include <numeric>

#include <catch2/catch.hpp>
#include <hwy/highway.h>

using namespace bem;

namespace {

template <class T>
void fill(DenseStore<T>& m) {
  for (std::size_t i = 0; i < m.rows(); ++i)
    for (std::size_t j = 0; j < m.columns(); ++j)
      m.row(i)[j] = static_cast<T>(std::sin(0.7 * i + 1.3 * j) / (1 + i + j));
}

template <class T>
double worst_error(const DenseStore<T>& m, int count) {
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(m.columns(), count);
  Eigen::MatrixXd y = Eigen::MatrixXd::Ones(m.rows(), count);
  m.multiply_add(x.data(), y.data(), count);
  double worst = 0;
  for (std::size_t i = 0; i < m.rows(); ++i)
    for (int c = 0; c < count; ++c) {
      double sum = 1;
      for (std::size_t j = 0; j < m.columns(); ++j) sum += m.row(i)[j] * x(j, c);
      worst = std::max(worst, std::abs(sum - y(i, c)));
    }
  return worst;
}

}  // namespace

TEMPLATE_TEST_CASE("products agree with plain loops on every instruction set", "", float, double) {
  for (auto [rows, columns] : {std::pair{1, 1}, {3, 7}, {97, 64}, {200, 131}}) {
    DenseStore<TestType> m(rows, columns);
    fill(m);
    for (int count : {1, 2, 3, 4, 6})
      for (int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        CHECK(worst_error(m, count) < 1e-13);
        hwy::SetSupportedTargetsForTest(0);
      }
  }
}

TEST_CASE("products are bit-identical for any number of threads and right-hand sides") {
  DenseStore<float> m(500, 333);
  fill(m);
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(333, 3);
  std::vector<Eigen::MatrixXd> results;
  for (int threads : {1, 2, 5}) {
    set_thread_count(threads);
    Eigen::MatrixXd y = Eigen::MatrixXd::Zero(500, 3);
    m.multiply_add(x.data(), y.data(), 3);
    results.push_back(y);
  }
  Eigen::MatrixXd one_by_one = Eigen::MatrixXd::Zero(500, 3);
  for (int c = 0; c < 3; ++c) m.multiply_add(x.col(c).data(), one_by_one.col(c).data(), 1);
  CHECK(results[0] == results[1]);
  CHECK(results[0] == results[2]);
  CHECK(results[0] == one_by_one);
}

TEST_CASE("transposed products, sparse products and blocks agree with the entries") {
  DenseStore<double> m(40, 600);
  fill(m);
  std::vector<int> rows(40), columns(600);
  std::iota(rows.begin(), rows.end(), 0);
  std::iota(columns.begin(), columns.end(), 0);
  const Eigen::MatrixXd entries = m.block(rows, columns);
  CHECK(entries(7, 599) == m.row(7)[599]);
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(40, 3);
  Eigen::MatrixXd y = Eigen::MatrixXd::Ones(600, 3);
  m.multiply_transposed_add(x.data(), y.data(), 3);
  CHECK((y - entries.transpose() * x).isApproxToConstant(1, 1e-13));
  const Eigen::VectorXd few = Eigen::VectorXd::Random(2);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(40);
  m.multiply_add_columns({3, 598}, few.data(), sum.data());
  CHECK((sum - entries.col(3) * few[0] - entries.col(598) * few[1]).norm() < 1e-14);
}
