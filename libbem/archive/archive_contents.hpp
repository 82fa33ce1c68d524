#pragma once

#include "archive/archive_tables.hpp"
#include "files/hdf5.hpp"

#include <optional>

namespace bem {

/// Checks that a number is there, finite and in its range. Throws with the file's code.
void check_number(const Hdf5File& file, const StoredNumber& number);

/// Holds a file to the tables below. Every count is what the first dataset that has it says;
/// expect() gives those that are known from elsewhere. Throws with the file's code and names the
/// place.
class ArchiveContents {
 public:
  void expect(Count count, std::size_t value) { known_[static_cast<std::size_t>(count)] = value; }

  /// Type and extents of a dataset.
  void check(const Hdf5File& file, const StoredDataset& dataset, const std::string& path);
  /// Of all datasets of a table, with `group` in front of their paths.
  template <class Table>
  void check_datasets(const Hdf5File& file, const Table& table, const std::string& group = "") {
    for (const StoredDataset& dataset : table) check(file, dataset, group + dataset.path);
  }

 private:
  std::array<std::optional<std::size_t>, static_cast<std::size_t>(Count::kinds)> known_;
};

template <class Table>
void check_numbers(const Hdf5File& file, const Table& table) {
  for (const StoredNumber& number : table) check_number(file, number);
}

}  // namespace bem
