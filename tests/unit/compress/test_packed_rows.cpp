#include "base/error.hpp"
#include "compress/packed_rows.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

constexpr int kColumns = 200000;
const std::vector<int> kSomeColumns = {0, 1, 254, 509, 510, 1000, 66537, 132073, 199999};

std::vector<float> some_values() {
  std::vector<float> values;
  for (std::size_t i = 0; i < kSomeColumns.size(); ++i)
    values.push_back((i % 2 == 0 ? 1.0F : -1.0F) * std::pow(10.0F, 3.0F - static_cast<float>(i)) /
                     3);
  return values;
}

PackedRows packed(PackedFormat format) {
  const std::vector<float> values = some_values();
  PackedRows rows(format, format == PackedFormat::half ? PackedRows::scale_for(values[0]) : 1.0F);
  rows.add_row(nullptr, nullptr, 0);
  rows.add_row(kSomeColumns.data(), values.data(), values.size());
  rows.add_row(kSomeColumns.data() + 3, values.data(), 2);
  return rows;
}

std::vector<std::int32_t> table_of(const PackedRows& rows) {
  std::vector<std::int32_t> table;
  for (std::size_t r = 0; r < rows.rows(); ++r)
    for (std::size_t n : {rows.entries(r), rows.gap_bytes(r)})
      table.push_back(static_cast<std::int32_t>(n));
  return table;
}

}  // namespace

TEST_CASE("packed rows give back what was put in") {
  const PackedFormat format = GENERATE(PackedFormat::half, PackedFormat::single);
  const PackedRows rows = packed(format);
  REQUIRE(rows.rows() == 3);
  CHECK(rows.entries() == kSomeColumns.size() + 2);
  CHECK(rows.gap_bytes(1) == 1 + 1 + 1 + 3 + 1 + 3 + 5 + 3 + 5);
  std::vector<int> columns;
  std::vector<float> values;
  rows.unpack(1, columns, values);
  CHECK(columns == kSomeColumns);
  const std::vector<float> original = some_values();
  for (std::size_t i = 0; i < original.size(); ++i) {
    const float accuracy = format == PackedFormat::half ? 4.9e-4F : 0.0F;
    CHECK(std::abs(values[i] - original[i]) <= accuracy * std::abs(original[i]));
  }
  std::vector<float> x(kColumns, 0.0F);
  x[254] = 2;
  x[199999] = 3;
  CHECK(rows.multiply(0, x.data()) == 0);
  CHECK(rows.multiply(1, x.data()) == Approx(2 * values[2] + 3 * values.back()).epsilon(1e-6));
  std::vector<double> y(kColumns, 1.0);
  rows.add_to(1, -2, y.data());
  CHECK(y[510] == 1 - 2.0 * static_cast<double>(values[4]));
  CHECK(y[511] == 1);

  PackedRows twice = rows;
  twice.append(rows);
  std::vector<int> again;
  twice.unpack(4, again, values);
  CHECK(again == kSomeColumns);
}

TEST_CASE("rounding errors of packed rows are known") {
  const std::vector<float> values = some_values();
  PackedRows rows(PackedFormat::half, PackedRows::scale_for(values[0]));
  const double squared = rows.add_row(kSomeColumns.data(), values.data(), values.size());
  std::vector<int> columns;
  std::vector<float> rounded;
  rows.unpack(0, columns, rounded);
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    sum += std::pow(double(rounded[i] - values[i]), 2);
  CHECK(squared > 0);
  CHECK(squared == Approx(sum));
}

TEST_CASE("packed rows are made of parts, which must fit") {
  const PackedFormat format = GENERATE(PackedFormat::half, PackedFormat::single);
  const PackedRows rows = packed(format);
  const std::vector<std::int32_t> table = table_of(rows);
  const auto make = [&](const std::vector<std::int32_t>& t, std::vector<std::uint8_t> gaps,
                        std::vector<std::uint8_t> values, int columns = kColumns) {
    return PackedRows::from_parts(format, rows.scale(), t, std::move(gaps), std::move(values),
                                  columns);
  };
  const PackedRows back = make(table, rows.gaps(), rows.values());
  CHECK(table_of(back) == table);
  std::vector<int> columns;
  std::vector<float> values;
  back.unpack(1, columns, values);
  CHECK(columns == kSomeColumns);

  CHECK_THROWS_AS(make(table, rows.gaps(), rows.values(), kColumns - 1), Error);
  std::vector<std::uint8_t> longer = rows.gaps();
  longer.push_back(0);
  CHECK_THROWS_AS(make(table, longer, rows.values()), Error);
  longer = rows.values();
  longer.push_back(0);
  CHECK_THROWS_AS(make(table, rows.gaps(), longer), Error);
  for (std::size_t i = 0; i < table.size(); ++i)
    for (int change : {-1, 1}) {
      std::vector<std::int32_t> wrong = table;
      wrong[i] += change;
      CHECK_THROWS_AS(make(wrong, rows.gaps(), rows.values()), Error);
    }
  std::vector<std::uint8_t> gaps = rows.gaps();
  gaps[gaps.size() - 4] = 255;  // of the last row: five bytes where there are fewer
  CHECK_THROWS_AS(make(table, gaps, rows.values()), Error);
  if (format == PackedFormat::single) {
    std::vector<std::uint8_t> bad = rows.values();
    bad[2] = 0x80;  // little-endian: an infinity
    bad[3] = 0x7f;
    bad[0] = bad[1] = 0;
    CHECK_THROWS_AS(make(table, rows.gaps(), bad), Error);
  }
}
