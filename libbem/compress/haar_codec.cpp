#include "compress/haar_codec.hpp"

#include "compress/haar_builder.hpp"
#include "compress/haar_storage.hpp"
#include "mesh/describe.hpp"

#include <algorithm>

namespace bem {
namespace {

class HaarCodec : public Codec {
 public:
  const char* name() const override { return "haar"; }
  double rounding() const override { return 1e-6; }
  bool takes_ratio() const override { return true; }
  std::string options_text(const CodecOptions& options) const override {
    return std::string("--codec haar ") + (options.ratio > 0
                                               ? "--compression-ratio " + to_text(options.ratio)
                                               : "--codec-tol " + to_text(options.tolerance));
  }

  std::vector<Slab> slabs(const std::vector<Vec3>& nodes) const override {
    const std::vector<int> firsts = HaarBuilder::slabs(static_cast<int>(nodes.size()));
    std::vector<Slab> slabs;
    for (std::size_t s = 0; s + 1 < firsts.size(); ++s)
      slabs.push_back({firsts[s], firsts[s + 1], {}});
    return slabs;
  }
  std::unique_ptr<FamilyBuilder<float>> single_builder(const CodecOptions& options, int nodes,
                                                       int count) const override {
    return std::make_unique<HaarBuilder>(nodes, count, options);
  }
  /// With a tolerance as many as there are.
  double expected_bytes(double entries, const CodecOptions& options) const override {
    constexpr double kWithPlaces = 1.5;  // a coefficient and its place
    return entries * sizeof(float) *
           (options.ratio > 0 ? std::min(1.0, kWithPlaces / options.ratio) : 1.0);
  }

  void check_datasets(const Hdf5File& file, const FamilyPlace& place,
                      std::size_t /*size*/) const override {
    check_family_group(
        file, place,
        {{"/rows", Hdf5Type::int32, 2}, {"/gaps", Hdf5Type::uint8}, {"/values", Hdf5Type::uint8}});
  }
  double bytes(const Hdf5File& file, const FamilyPlace& place,
               std::size_t /*size*/) const override {
    return static_cast<double>(bytes_in_group(file, place, {"/gaps", "/values"}));
  }
  std::size_t coefficients(const Hdf5File& /*file*/, const FamilyPlace& /*place*/,
                           std::size_t size) const override {
    return size;
  }
  std::unique_ptr<MatrixFamily> read(const Hdf5File& file, const FamilyPlace& place,
                                     std::size_t size, const std::vector<int>* columns,
                                     const BytesReport& report) const override {
    return read_haar(file, place.group, size, place.count(), columns, report);
  }
};

}  // namespace

const Codec& haar_codec() {
  static const HaarCodec codec;
  return codec;
}

}  // namespace bem
