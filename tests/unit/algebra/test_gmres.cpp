#include "algebra/gmres.hpp"

#include <cmath>
#include <type_traits>

#include <Eigen/LU>
#include <catch2/catch.hpp>

using namespace bem;

namespace {

/// A matrix that is far from symmetric, with eigenvalues about 4.
template <class T>
ColumnsOf<T> test_matrix(Eigen::Index n) {
  ColumnsOf<T> m(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      m(i, j) = std::sin(static_cast<double>(3 * i * i + 7 * j)) / static_cast<double>(n);
      if constexpr (std::is_same_v<T, Complex>)
        m(i, j) +=
            Complex(0, std::cos(static_cast<double>(i + 2 * j * j)) / static_cast<double>(n));
    }
  m.diagonal().array() += T(4);
  return m;
}

template <class T>
ColumnOperator<T> product(const ColumnsOf<T>& a) {
  return [a](const ColumnsOf<T>& x) { return ColumnsOf<T>(a * x); };
}

/// Sends every unit vector to the next one: GMRES from the first learns nothing until the last.
ColumnOperator<double> shift() {
  return [](const ColumnsOf<double>& x) {
    ColumnsOf<double> y(x.rows(), x.cols());
    y.topRows(1) = x.bottomRows(1);
    y.bottomRows(x.rows() - 1) = x.topRows(x.rows() - 1);
    return y;
  };
}

}  // namespace

TEMPLATE_TEST_CASE("gmres solves several systems at once", "", double, Complex) {
  using Columns = ColumnsOf<TestType>;
  const Columns a = test_matrix<TestType>(60);
  Columns solution(60, 3);
  for (Eigen::Index i = 0; i < solution.size(); ++i)
    solution(i % 60, i / 60) = std::sin(static_cast<double>(i + 1));
  Columns b = a * solution;
  SECTION("from zero") {
    Columns x = Columns::Zero(60, 3);
    const GmresResult r = gmres<TestType>(product<TestType>(a), b, x, {});
    CHECK(r.residual <= 1e-12);
    CHECK(r.iterations < 30);
    CHECK((x - solution).norm() < 1e-11 * solution.norm());
  }
  SECTION("from nearby") {
    Columns x = solution + 1e-6 * b;
    const GmresResult r = gmres<TestType>(product<TestType>(a), b, x, {1e-8});
    CHECK(r.iterations < 4);
    CHECK((a * x - b).norm() < 2e-8 * b.norm());
  }
  SECTION("with the inverse as preconditioner, in one iteration") {
    const Columns inverse = a.inverse();
    Columns x = Columns::Zero(60, 3);
    const GmresResult r =
        gmres<TestType>(product<TestType>(a), b, x, {1e-10}, product<TestType>(inverse));
    CHECK(r.iterations == 1);
    CHECK((x - solution).norm() < 1e-9 * solution.norm());
  }
  SECTION("beside a right-hand side of zero") {
    b.col(1).setZero();
    Columns x = Columns::Zero(60, 3);
    CHECK(gmres<TestType>(product<TestType>(a), b, x, {}).residual <= 1e-12);
    CHECK(x.col(1).isZero(0));
    CHECK((a * x - b).norm() < 1e-11 * b.norm());
  }
}

TEST_CASE("gmres waits for residuals that fall late as long as it is told to") {
  const ColumnsOf<double> b = ColumnsOf<double>::Identity(40, 1);
  ColumnsOf<double> x = ColumnsOf<double>::Zero(40, 1);
  SECTION("long enough") {
    const GmresResult r = gmres<double>(shift(), b, x, {1e-12, 200, 60});
    CHECK(r.iterations == 40);
    CHECK(r.residual <= 1e-12);
    CHECK(x(39, 0) == Approx(1));
  }
  SECTION("not long enough") {
    const GmresResult r = gmres<double>(shift(), b, x, {1e-12, 200, 15});
    CHECK(r.iterations == 15);
    CHECK(r.residual == Approx(1));
  }
  SECTION("and no longer than its iterations") {
    CHECK(gmres<double>(shift(), b, x, {1e-12, 30, 60}).iterations == 30);
    CHECK(x.allFinite());
  }
}
