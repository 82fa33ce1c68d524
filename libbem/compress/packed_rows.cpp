#include "compress/packed_rows.hpp"

#include "base/error.hpp"
#include "base/types.hpp"

#include <cmath>
#include <cstring>
#include <string>

namespace bem {
namespace {

constexpr std::uint32_t kTwoBytes = 254, kFourBytes = 255;

void put_gap(std::uint32_t gap, std::vector<std::uint8_t>& to) {
  const auto put = [&](int bytes) {
    for (int i = 0; i < bytes; ++i) to.push_back(static_cast<std::uint8_t>(gap >> (8 * i)));
  };
  if (gap < kTwoBytes) {
    put(1);
  } else if (gap <= 0xffff) {
    to.push_back(kTwoBytes);
    put(2);
  } else {
    to.push_back(kFourBytes);
    put(4);
  }
}

/// Bytes of a gap from its first one.
std::size_t gap_length(std::uint8_t first) {
  return first < kTwoBytes ? 1 : first == kTwoBytes ? 3 : 5;
}

std::uint32_t long_gap(const std::uint8_t* from) {
  std::uint32_t gap = 0;
  for (std::size_t i = gap_length(*from) - 1; i > 0; --i) gap = gap << 8 | from[i];
  return gap;
}

/// Exact; there are no infinities.
inline float from_half(std::uint16_t half) {
  const std::uint32_t bits = (half & 0x8000U) << 16 | (half & 0x7fffU) << 13;
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value * 0x1p112F;  // other bias of the exponent
}

/// Values by number, without the scale.
struct Halves {
  const std::uint8_t* data;
  float operator[](std::size_t i) const {
    std::uint16_t half = 0;
    std::memcpy(&half, data + 2 * i, sizeof half);
    return from_half(half);
  }
};
struct Singles {
  const std::uint8_t* data;
  float operator[](std::size_t i) const {
    float value = 0;
    std::memcpy(&value, data + 4 * i, sizeof value);
    return value;
  }
};

/// Goes from entry to entry of a row.
class EntryColumns {
 public:
  explicit EntryColumns(const std::uint8_t* gaps) : at_(gaps) {}
  std::uint32_t next() {
    std::uint32_t gap = *at_;
    if (gap < kTwoBytes) {
      ++at_;
    } else {
      gap = long_gap(at_);
      at_ += gap_length(*at_);
    }
    return column_ += gap + 1;
  }

 private:
  const std::uint8_t* at_;
  std::uint32_t column_ = static_cast<std::uint32_t>(-1);
};

void check(bool right, const char* what) {
  if (!right) throw Error(ErrorCode::invalid_input, std::string("not so: ") + what);
}

template <class Values>
float multiply_row(const std::uint8_t* gaps, Values values, std::size_t count, const float* x) {
  constexpr std::size_t kSums = 4;  // additions do not wait for each other
  float sums[kSums] = {};
  EntryColumns columns(gaps);
  std::size_t i = 0;
  for (; i + kSums <= count; i += kSums)
    for (std::size_t s = 0; s < kSums; ++s) sums[s] += values[i + s] * x[columns.next()];
  for (; i < count; ++i) sums[0] += values[i] * x[columns.next()];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace

float PackedRows::scale_for(float largest) {
  constexpr int kExponent = 15;  // the largest number is less than 2^15
  return std::ldexp(1.0F, std::ilogb(largest) + 1 - kExponent);
}

double PackedRows::add_row(const int* columns, const float* values, std::size_t count) {
  double squared_error = 0;
  int previous = -1;
  std::size_t at = values_.size();
  values_.resize(at + count * value_bytes());
  for (std::size_t i = 0; i < count; ++i) {
    put_gap(static_cast<std::uint32_t>(columns[i] - previous - 1), gaps_);
    previous = columns[i];
    if (format_ == PackedFormat::half) {
      const Eigen::half rounded(values[i] / scale_);
      std::memcpy(&values_[at], &rounded.x, 2);
      const double error = static_cast<double>(static_cast<float>(rounded) * scale_ - values[i]);
      squared_error += error * error;
    } else {
      std::memcpy(&values_[at], &values[i], 4);
    }
    at += value_bytes();
  }
  value_ends_.push_back(values_.size() / value_bytes());
  gap_ends_.push_back(gaps_.size());
  return squared_error;
}

void PackedRows::append(const PackedRows& rows) {
  require(rows.format_ == format_ && rows.scale_ == scale_, "rows of one format are joined");
  const std::size_t entries_before = entries(), gaps_before = gaps_.size();
  for (std::size_t r = 0; r < rows.rows(); ++r) {
    value_ends_.push_back(entries_before + rows.value_ends_[r]);
    gap_ends_.push_back(gaps_before + rows.gap_ends_[r]);
  }
  gaps_.insert(gaps_.end(), rows.gaps_.begin(), rows.gaps_.end());
  values_.insert(values_.end(), rows.values_.begin(), rows.values_.end());
}

PackedRows PackedRows::from_parts(PackedFormat format, float scale,
                                  const std::vector<std::int32_t>& table,
                                  std::vector<std::uint8_t> gaps, std::vector<std::uint8_t> values,
                                  int columns) {
  PackedRows out(format, scale);
  std::size_t entries = 0, at = 0;
  for (std::size_t r = 0; 2 * r < table.size(); ++r) {
    check(table[2 * r] >= 0 && table[2 * r + 1] >= 0, "rows have no negative sizes");
    const auto count = static_cast<std::size_t>(table[2 * r]);
    const std::size_t end = at + static_cast<std::size_t>(table[2 * r + 1]);
    check(end <= gaps.size(), "the gaps of a row are there");
    std::int64_t column = -1;
    for (std::size_t i = 0; i < count; ++i) {
      check(at < end && gap_length(gaps[at]) <= end - at, "every entry has its gap");
      column +=
          1 + static_cast<std::int64_t>(gaps[at] < kTwoBytes ? gaps[at] : long_gap(&gaps[at]));
      at += gap_length(gaps[at]);
    }
    check(at == end && column < columns, "the entries of a row are within the matrix");
    entries += count;
    out.value_ends_.push_back(entries);
    out.gap_ends_.push_back(end);
  }
  check(at == gaps.size() && entries * out.value_bytes() == values.size(), "all data are of rows");
  if (format == PackedFormat::single)
    for (std::size_t i = 0; i < entries; ++i)
      check(std::isfinite(Singles{values.data()}[i]), "values are finite");
  out.gaps_ = std::move(gaps);
  out.values_ = std::move(values);
  return out;
}

float PackedRows::multiply(std::size_t row, const float* x) const {
  const std::uint8_t* gaps = gaps_.data() + first_gap(row);
  const std::uint8_t* values = values_.data() + value_bytes() * first_value(row);
  return format_ == PackedFormat::half
             ? multiply_row(gaps, Halves{values}, entries(row), x) * scale_
             : multiply_row(gaps, Singles{values}, entries(row), x);
}

template <class F>
void PackedRows::for_each(std::size_t row, const F& f) const {
  EntryColumns columns(gaps_.data() + first_gap(row));
  const std::uint8_t* values = values_.data() + value_bytes() * first_value(row);
  const std::size_t count = entries(row);
  if (format_ == PackedFormat::half)
    for (std::size_t i = 0; i < count; ++i) f(columns.next(), Halves{values}[i] * scale_);
  else
    for (std::size_t i = 0; i < count; ++i) f(columns.next(), Singles{values}[i]);
}

void PackedRows::add_to(std::size_t row, double factor, double* y) const {
  for_each(row, [&](std::uint32_t column, float value) {
    y[column] += factor * static_cast<double>(value);
  });
}

void PackedRows::unpack(std::size_t row, std::vector<int>& columns,
                        std::vector<float>& values) const {
  columns.clear();
  values.clear();
  for_each(row, [&](std::uint32_t column, float value) {
    columns.push_back(static_cast<int>(column));
    values.push_back(value);
  });
}

}  // namespace bem
