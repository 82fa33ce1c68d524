#include "base/parallel.hpp"
#include "compress/haar_builder.hpp"
#include "mesh/shapes.hpp"
#include "support/matrix_examples.hpp"

#include <functional>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

using FloatMatrix = Eigen::MatrixXf;

struct HaarExample : MatrixExample {
  using MatrixExample::MatrixExample;

  std::size_t entries() const { return kMatrices * 9 * nodes.size() * nodes.size(); }

  std::unique_ptr<MatrixFamily> compress(const CodecOptions& options,
                                         double* error = nullptr) const {
    const int n = static_cast<int>(nodes.size());
    HaarBuilder builder(n, kMatrices, options);
    const std::vector<int> slabs = HaarBuilder::slabs(n);
    for (std::size_t s = 0; s + 1 < slabs.size(); ++s) {
      std::vector<MatrixView<float>> rows;
      for (const FloatMatrix& m : matrices)
        rows.emplace_back(m.data() + 3 * slabs[s], 3 * (slabs[s + 1] - slabs[s]), m.cols(),
                          Eigen::OuterStride<>(m.rows()));
      builder.add_rows(rows);
    }
    auto family = builder.finish();
    if (error) *error = builder.error();
    return family;
  }
};

/// 203 nodes: slabs of different sizes, no power of two.
const HaarExample& cube() {
  static const HaarExample example = [] {
    std::vector<Vec3> points = bumpy_cube(1, 6, 0.2).vertices;
    points.resize(203);
    return HaarExample(points);
  }();
  return example;
}

CodecOptions tolerance(double t) {
  return CodecOptions(codec_named("haar"), t);
}
CodecOptions ratio(double r) {
  return CodecOptions(codec_named("haar"), 1e-4, r);
}

std::size_t kept(const MatrixFamily& family) {
  return dynamic_cast<const HaarFamily&>(family).packed().entries();
}

/// Magnitudes of the coefficients of the whole matrices in double precision, by the definition of
/// the wavelets: constant on the two halves of a range, of mean zero and norm one.
std::vector<double> coefficients_by_definition(const HaarExample& example) {
  const auto n = static_cast<Eigen::Index>(example.nodes.size());
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(n, n);
  w.row(0).setConstant(1 / std::sqrt(static_cast<double>(n)));
  const std::function<void(Eigen::Index, Eigen::Index)> cut = [&](Eigen::Index begin,
                                                                  Eigen::Index count) {
    if (count < 2) return;
    const Eigen::Index left = count / 2, right = count - left;
    w.row(begin + left).segment(begin, left).setConstant(1.0 / static_cast<double>(left));
    w.row(begin + left).segment(begin + left, right).setConstant(-1.0 / static_cast<double>(right));
    w.row(begin + left).normalize();
    cut(begin, left);
    cut(begin + left, right);
  };
  cut(0, n);
  std::vector<double> all;
  for (const FloatMatrix& m : example.matrices)
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        const Eigen::MatrixXd part = m.cast<double>()(Eigen::seqN(a, n, 3), Eigen::seqN(b, n, 3));
        const Eigen::MatrixXd c = w * part * w.transpose();
        for (Eigen::Index i = 0; i < c.size(); ++i) all.push_back(std::abs(c.data()[i]));
      }
  std::sort(all.begin(), all.end(), std::greater<>());
  return all;
}

}  // namespace

TEST_CASE("a Haar family meets its tolerance and uses it") {
  std::size_t last = 0;
  for (double t : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    double reported = 0;
    const auto family = cube().compress(tolerance(t), &reported);
    const double error = cube().error_of(*family);
    CAPTURE(t, error, reported, family->bytes());
    CHECK(error <= t);
    CHECK(error > 0.95 * t);
    CHECK(reported == Approx(error).epsilon(0.01));
    CHECK(family->bytes() > last);
    last = family->bytes();
  }
}

TEST_CASE("a compression ratio keeps the largest coefficients of the whole family, so many") {
  const std::vector<double> all = coefficients_by_definition(cube());
  REQUIRE(all.size() == cube().entries());
  for (double r : {1.5, 3.0, 8.0, 100.0}) {
    double reported = 0;
    const auto family = cube().compress(ratio(r), &reported);
    const auto count = static_cast<std::size_t>(static_cast<double>(cube().entries()) / r);
    CHECK(kept(*family) == count);
    double lost = 0;
    for (std::size_t i = count; i < all.size(); ++i) lost += all[i] * all[i];
    const double best = std::sqrt(lost) / cube().norm;
    const double rounding = best >= 1e-3 ? 3e-4 : 1e-6;
    CAPTURE(r, best, reported);
    CHECK(cube().error_of(*family) == Approx(best).margin(rounding));
    CHECK(reported == Approx(best).margin(rounding));
  }
}

TEST_CASE("bytes of a Haar family are those of its entries") {
  for (double t : {1e-2, 1e-4}) {
    const auto family = cube().compress(tolerance(t));
    const PackedRows& packed = dynamic_cast<const HaarFamily&>(*family).packed();
    CHECK(packed.format() == (t == 1e-2 ? PackedFormat::half : PackedFormat::single));
    CHECK(family->bytes() == packed.entries() * packed.value_bytes() + packed.gaps().size() +
                                 8 * kMatrices * 3 * cube().nodes.size());
    CHECK(packed.gaps().size() < 1.2 * static_cast<double>(packed.entries()));
  }
}

TEST_CASE("products, sparse and transposed ones of a Haar family agree with its entries") {
  const double t = GENERATE(1e-2, 1e-4);
  const auto family = cube().compress(tolerance(t));
  const auto n = static_cast<Eigen::Index>(family->rows());
  std::vector<Eigen::MatrixXd> full;
  for (int k = 0; k < kMatrices; ++k) full.push_back(full_matrix(*family, k));
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(n, 2 * kMatrices);

  Eigen::MatrixXd expected = Eigen::MatrixXd::Ones(n, 2);
  for (int c = 0; c < 2 * kMatrices; ++c)
    expected.col(c % 2) += 0.5 * full[c % kMatrices] * x.col(c);
  CHECK((products(*family, x, 2) - expected).norm() < 3e-6 * expected.norm());

  const std::vector<int> columns = {0, 4, 5, 300, static_cast<int>(n) - 1};
  const Eigen::VectorXd values = Eigen::VectorXd::Random(5);
  const auto restricted = dynamic_cast<const HaarFamily&>(*family).restrict_to(columns);
  CHECK(restricted->bytes() < family->bytes());
  const Eigen::VectorXd sparse = 2 * full[1](Eigen::all, columns) * values;
  for (const MatrixFamily* f : std::vector<const MatrixFamily*>{family.get(), restricted.get()}) {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
    f->multiply_add(std::vector<SparseTerm>{{1, &columns, values.data(), 0, 2.0}}, {y.data()});
    CHECK((y - sparse).norm() < 3e-6 * sparse.norm());
  }

  Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
  family->multiply_transposed_add(
      {{0, x.col(0).data(), nullptr, 0, 1.0}, {2, x.col(1).data(), nullptr, 0, -3.0}}, {y.data()});
  const Eigen::VectorXd transposed =
      full[0].transpose() * x.col(0) - 3 * full[2].transpose() * x.col(1);
  CHECK((y - transposed).norm() < 3e-6 * transposed.norm());
}

TEST_CASE("sums of matrices of a Haar family and blocks of them") {
  const auto family = cube().compress(tolerance(1e-3));
  const auto sums = family->combine({{1, 1, 1}, {0, 2, -1}});
  REQUIRE(sums->count() == 2);
  const Eigen::MatrixXd all =
      full_matrix(*family, 0) + full_matrix(*family, 1) + full_matrix(*family, 2);
  CHECK((full_matrix(*sums, 0) - all).norm() < 1e-6 * all.norm());
  const Eigen::MatrixXd other = 2 * full_matrix(*family, 1) - full_matrix(*family, 2);
  CHECK((full_matrix(*sums, 1) - other).norm() < 1e-6 * other.norm());
  const std::vector<int> rows = {600, 3, 4, 31}, columns = {500, 2, 200};
  CHECK(family->block(1, rows, columns) == full_matrix(*family, 1)(rows, columns));
}

TEST_CASE("Haar compression and products are bit-identical for any number of threads") {
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(3 * cube().nodes.size(), kMatrices);
  std::vector<Eigen::MatrixXd> results;
  std::vector<std::vector<std::uint8_t>> bytes;
  for (int threads : {1, 2, 5}) {
    set_thread_count(threads);
    const auto family = cube().compress(ratio(6));
    results.push_back(products(*family, x, 1));
    bytes.push_back(dynamic_cast<const HaarFamily&>(*family).packed().values());
  }
  CHECK(results[0] == results[1]);
  CHECK(results[0] == results[2]);
  CHECK(bytes[0] == bytes[1]);
  CHECK(bytes[0] == bytes[2]);
}

TEST_CASE("tiny bodies and vanishing matrices are Haar compressed, too") {
  const HaarExample tetrahedron({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  CHECK(tetrahedron.error_of(*tetrahedron.compress(tolerance(1e-4))) <= 1e-4);
  CHECK(kept(*tetrahedron.compress(ratio(10))) == tetrahedron.entries() / 10);
  CHECK(kept(*tetrahedron.compress(ratio(1e6))) == 1);

  const FloatMatrix zeros = FloatMatrix::Zero(12, 12);
  for (const CodecOptions& options : {tolerance(1e-3), tolerance(1e-5), ratio(4)}) {
    HaarBuilder builder(4, 1, options);
    builder.add_rows({MatrixView<float>(zeros.data(), 12, 12, Eigen::OuterStride<>(12))});
    const auto nothing = builder.finish();
    CHECK(kept(*nothing) == 0);
    CHECK(builder.error() == 0);
    CHECK(full_matrix(*nothing, 0).isZero(0));
  }
}
