#include "compress/family_storage.hpp"

namespace bem {

void check_family_group(const Hdf5File& file, const FamilyPlace& place,
                        std::initializer_list<FamilyDataset> datasets) {
  for (const FamilyDataset& d : datasets) {
    const std::string path = place.group + d.name;
    const Hdf5Dims found = file.dims(path);
    Hdf5Dims expected = {found.empty() ? 0 : found[0]};
    if (d.columns > 0) expected.push_back(d.columns);
    file.require_dataset(path, d.type, expected);
  }
  if (file.int_attribute(place.group, "matrices") != place.count())
    throw Error(ErrorCode::archive,
                file.path() + ": " + place.group + " is a family of another number of matrices");
}

std::size_t bytes_in_group(const Hdf5File& file, const FamilyPlace& place,
                           std::initializer_list<const char*> names) {
  std::size_t bytes = 0;
  for (const char* name : names) bytes += file.dims(place.group + name).at(0);
  return bytes;
}

}  // namespace bem
