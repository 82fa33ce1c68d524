#include "archive/archive_contents.hpp"

#include <cmath>

namespace bem {

void ArchiveContents::check(const Hdf5File& file, const StoredDataset& dataset,
                            const std::string& path) {
  const Hdf5Dims found = file.dims(path);
  Hdf5Dims expected = found;
  expected.resize(static_cast<std::size_t>(dataset.rank));
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const Extent& extent = dataset.extents[k];
    if (extent.fixed >= 0) {
      expected[k] = static_cast<std::size_t>(extent.fixed);
    } else if (extent.count != Count::bytes) {
      auto& count = known_[static_cast<std::size_t>(extent.count)];
      if (!count && k < found.size()) count = found[k];
      expected[k] = count.value_or(0);
    }
  }
  file.require_dataset(path, dataset.type, expected);
}

void check_number(const Hdf5File& file, const StoredNumber& number) {
  if (number.optional && !file.has_attribute(number.group, number.name)) return;
  const double value = file.double_attribute(number.group, number.name);
  if (!(std::isfinite(value) && value >= number.least && value <= number.most))
    throw Error(file.error(), file.path() + ": " + number.group + ": attribute \"" + number.name +
                                  "\" is out of its range");
}

}  // namespace bem
