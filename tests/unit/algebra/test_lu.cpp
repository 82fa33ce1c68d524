#include "algebra/lu.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

template <class T>
DenseMatrix<T> test_matrix(int rows, int cols) {
  unsigned state = 7;
  const auto uniform = [&state] {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) / double(1 << 24) - 0.5;
  };
  DenseMatrix<T> m(rows, cols);
  for (int j = 0; j < cols; ++j)
    for (int i = 0; i < rows; ++i) {
      if constexpr (std::is_same_v<T, double>)
        m(i, j) = uniform();
      else
        m(i, j) = T(uniform(), uniform());
    }
  return m;
}

}  // namespace

TEMPLATE_TEST_CASE("LU solves and inverts in place", "", double, Complex) {
  for (int n : {1, 5, 17, 129, 300, 700}) {
    const DenseMatrix<TestType> a = test_matrix<TestType>(n, n);
    const DenseMatrix<TestType> b = test_matrix<TestType>(n, 3);
    Lu<TestType> lu{DenseMatrix<TestType>(a)};
    DenseMatrix<TestType> x = b;
    lu.solve(x);
    CHECK((a * x - b).norm() < 1e-9 * b.norm());
    CHECK(lu.norm1() == Approx(norm1(a)));
    const DenseMatrix<TestType> inverse = std::move(lu).invert();
    CHECK((a * inverse - DenseMatrix<TestType>::Identity(n, n)).norm() < 1e-9);
  }
}

TEMPLATE_TEST_CASE("results are bit-identical for any number of threads", "", double, Complex) {
  const DenseMatrix<TestType> a = test_matrix<TestType>(900, 900);
  std::vector<DenseMatrix<TestType>> inverses;
  for (int threads : {1, 2, 7}) {
    set_thread_count(threads);
    inverses.push_back(Lu<TestType>(DenseMatrix<TestType>(a)).invert());
  }
  CHECK(inverses[0] == inverses[1]);
  CHECK(inverses[0] == inverses[2]);
}

TEST_CASE("singular and non-finite matrices are refused") {
  DenseMatrix<double> a = test_matrix<double>(40, 40);
  a.col(7) = a.col(3);
  a.row(7) = a.row(3);
  a.col(7).setZero();
  CHECK_THROWS_AS(Lu<double>(std::move(a)), Error);
  DenseMatrix<double> b = test_matrix<double>(40, 40);
  b(3, 3) = std::nan("");
  CHECK_THROWS_AS(Lu<double>(std::move(b)), Error);
}
