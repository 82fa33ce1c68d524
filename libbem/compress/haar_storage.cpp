#include "compress/haar_storage.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

constexpr float kLargestHalf = 131072;  // that the bits of a half may mean here

/// Calls f(first, count) for pieces of `total` bytes.
template <class F>
void for_each_piece(std::size_t total, const F& f) {
  for (std::size_t first = 0; first < total; first += kPieceBytes)
    f(first, std::min(kPieceBytes, total - first));
}

}  // namespace

void write_haar(Hdf5File& file, const std::string& group, const HaarFamily& family,
                const BytesReport& report) {
  const PackedRows& packed = family.packed();
  std::vector<std::int32_t> table;
  table.reserve(2 * packed.rows());
  for (std::size_t r = 0; r < packed.rows(); ++r) {
    table.push_back(static_cast<std::int32_t>(packed.entries(r)));
    table.push_back(static_cast<std::int32_t>(packed.gap_bytes(r)));
  }
  file.create_group(group);
  file.set_attribute(group, "matrices", family.count());
  file.set_attribute(group, "scale", static_cast<double>(packed.scale()));
  file.set_attribute(group, "value_bytes", static_cast<int>(packed.value_bytes()));
  file.write(group + "/rows", table, {packed.rows(), 2});
  const auto write = [&](const std::string& name, const std::vector<std::uint8_t>& bytes) {
    file.create_dataset(group + name, Hdf5Type::uint8, {bytes.size()});
    for_each_piece(bytes.size(), [&](std::size_t first, std::size_t count) {
      file.write_rows(group + name, first, count, bytes.data() + first);
      report(count);
    });
  };
  write("/gaps", packed.gaps());
  write("/values", packed.values());
}

std::unique_ptr<HaarFamily> read_haar(const Hdf5File& file, const std::string& group,
                                      std::size_t size, int count, const std::vector<int>* columns,
                                      const BytesReport& report) {
  const auto check = [&](bool right, const std::string& what) {
    if (!right)
      throw Error(ErrorCode::archive, file.path() + ": " + group + what +
                                          " does not fit the other data of the archive");
  };
  const double scale = file.double_attribute(group, "scale");
  check(scale > 0 && std::isnormal(static_cast<float>(scale)) &&
            std::isfinite(static_cast<float>(scale) * kLargestHalf),
        ", attribute scale,");
  const std::int64_t value_bytes = file.int_attribute(group, "value_bytes");
  check(value_bytes == 2 || value_bytes == 4, ", attribute value_bytes,");
  const std::size_t rows = size * static_cast<std::size_t>(count);
  check(file.dims(group + "/rows") == Hdf5Dims{rows, 2}, "/rows");
  const auto table = file.read<std::int32_t>(group + "/rows", {rows, 2});
  const auto read = [&](const std::string& name) {
    std::vector<std::uint8_t> bytes(file.dims(group + name)[0]);
    for_each_piece(bytes.size(), [&](std::size_t first, std::size_t n) {
      file.read_rows(group + name, first, n, bytes.data() + first);
      report(n);
    });
    return bytes;
  };
  std::vector<std::uint8_t> gaps = read("/gaps"), values = read("/values");
  PackedRows packed;
  try {
    packed = PackedRows::from_parts(value_bytes == 2 ? PackedFormat::half : PackedFormat::single,
                                    static_cast<float>(scale), table, std::move(gaps),
                                    std::move(values), static_cast<int>(size));
  } catch (const Error& e) {
    throw Error(ErrorCode::archive, file.path() + ": " + group + " is damaged: " + e.what());
  }
  auto family = std::make_unique<HaarFamily>(size, count, std::move(packed));
  return columns ? family->restrict_to(*columns) : std::move(family);
}

}  // namespace bem
