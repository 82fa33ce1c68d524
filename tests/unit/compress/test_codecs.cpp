#include "base/error.hpp"
#include "compress/codec.hpp"
#include "compress/dense_family.hpp"

#include <algorithm>

#include <catch2/catch.hpp>

using namespace bem;

TEST_CASE("every codec is found by its name, an uncompressed one by its precision, too") {
  const std::vector<std::string> names = codec_names();
  CHECK(names == std::vector<std::string>{"none", "haar", "lowrank"});
  for (const std::string& name : names) {
    const Codec& codec = codec_named(name);
    CHECK(codec.name() == name);
    CHECK(codec.options_text(CodecOptions(codec)).find("--codec " + name) == 0);
    CHECK(codec.rounding() < 1e-5);
  }
  CHECK(codec_named("none", Precision::float64).is_double());
  CHECK_FALSE(codec_named("none").is_double());
  CHECK_FALSE(codec_named("lowrank").is_lossless());
  CHECK(find_codec("zip") == nullptr);
}

TEST_CASE("slabs of every codec cover all nodes in order") {
  std::vector<Vec3> nodes;
  for (int i = 0; i < 300; ++i) nodes.emplace_back(i, 0.1 * (i % 7), 0.2 * (i % 5));
  for (const std::string& name : codec_names()) {
    CAPTURE(name);
    int next = 0;
    for (const Slab& slab : codec_named(name).slabs(nodes)) {
      CHECK(slab.row_begin == next);
      CHECK(slab.row_end > slab.row_begin);
      next = slab.row_end;
    }
    CHECK(next == 300);
  }
}

TEST_CASE("a codec makes only the builders that it has") {
  const Codec &none = codec_named("none"), &exact = codec_named("none", Precision::float64),
              &lowrank = codec_named("lowrank");
  CHECK(none.single_builder(CodecOptions(none), 4, 1));
  CHECK(exact.double_builder(CodecOptions(exact), 4, 1));
  CHECK_THROWS_AS(none.double_builder(CodecOptions(none), 4, 1), Error);
  CHECK_THROWS_AS(exact.single_builder(CodecOptions(exact), 4, 1), Error);
  CHECK_THROWS_AS(lowrank.single_builder(CodecOptions(lowrank), 4, 1), Error);
  CHECK(none.expected_bytes(100, CodecOptions(none)) == 400);
  CHECK(exact.expected_bytes(100, CodecOptions(exact)) == 800);
}

TEST_CASE("rows times a matrix are the transposed products of the rows") {
  constexpr int kSize = 12;
  DenseFamily<double> family(kSize, 2);
  for (int k = 0; k < 2; ++k)
    std::generate_n(family.matrix(k).row(0), kSize * kSize,
                    [x = k + 1]() mutable { return (x = (x * 37 + 11) % 101) / 101.0; });
  const Eigen::MatrixXf rows = Eigen::MatrixXf::Random(5, kSize);
  const Eigen::MatrixXf found = family.multiply_left(rows, 1);
  const Eigen::MatrixXd expected = rows.cast<double>() * full_matrix(family, 1);
  CHECK((found.cast<double>() - expected).norm() < 1e-6 * expected.norm());
}
