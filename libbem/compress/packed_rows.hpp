#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bem {

/// Number format of the values of PackedRows.
enum class PackedFormat { half, single };

/// Rows of a sparse matrix in little memory. An entry is a value, in half precision and units of
/// `scale`, or in single precision, and the gap of columns since the entry before: in one byte if
/// it is less than 254; otherwise 254 and two bytes, or 255 and four, low ones first.
class PackedRows {
 public:
  explicit PackedRows(PackedFormat format = PackedFormat::single, float scale = 1)
      : format_(format), scale_(scale) {}

  /// A power of two by which numbers of at most this magnitude fit half precision.
  static float scale_for(float largest);

  /// Appends a row; `columns` ascend. Returns the sum of the squared rounding errors.
  double add_row(const int* columns, const float* values, std::size_t count);
  void append(const PackedRows& rows);

  /// The rows whose parts are given: entries and bytes of gaps of each, then the data of all.
  /// Throws ErrorCode::invalid_input if they do not fit together, with columns beyond `columns` or
  /// numbers that are not finite.
  static PackedRows from_parts(PackedFormat format, float scale,
                               const std::vector<std::int32_t>& table,
                               std::vector<std::uint8_t> gaps, std::vector<std::uint8_t> values,
                               int columns);

  std::size_t rows() const { return value_ends_.size(); }
  std::size_t entries() const { return value_ends_.empty() ? 0 : value_ends_.back(); }
  std::size_t entries(std::size_t row) const { return value_ends_[row] - first_value(row); }
  std::size_t gap_bytes(std::size_t row) const { return gap_ends_[row] - first_gap(row); }
  /// Of values, gaps and the numbers of both in each row.
  std::size_t bytes() const { return values_.size() + gaps_.size() + 8 * rows(); }

  PackedFormat format() const { return format_; }
  float scale() const { return scale_; }
  std::size_t value_bytes() const { return format_ == PackedFormat::half ? 2 : 4; }
  const std::vector<std::uint8_t>& gaps() const { return gaps_; }
  const std::vector<std::uint8_t>& values() const { return values_; }

  /// The row times x.
  float multiply(std::size_t row, const float* x) const;
  /// y += factor * the row.
  void add_to(std::size_t row, double factor, double* y) const;
  /// The entries of a row.
  void unpack(std::size_t row, std::vector<int>& columns, std::vector<float>& values) const;

 private:
  std::size_t first_value(std::size_t row) const { return row == 0 ? 0 : value_ends_[row - 1]; }
  std::size_t first_gap(std::size_t row) const { return row == 0 ? 0 : gap_ends_[row - 1]; }
  template <class F>
  void for_each(std::size_t row, const F& f) const;

  PackedFormat format_;
  float scale_;
  std::vector<std::size_t> value_ends_,
      gap_ends_;  ///< by row: entries, bytes of gaps up to its end
  std::vector<std::uint8_t> gaps_, values_;
};

}  // namespace bem
