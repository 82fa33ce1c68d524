#include "compress/dense_codec.hpp"

#include "compress/dense_family.hpp"
#include "compress/dense_storage.hpp"

#include <algorithm>

namespace bem {
namespace {

template <class T>
class DenseCodec : public Codec {
 public:
  static constexpr bool kSingle = std::is_same_v<T, float>;

  const char* name() const override { return "none"; }
  std::optional<Precision> precision() const override {
    return kSingle ? Precision::float32 : Precision::float64;
  }
  double rounding() const override { return kSingle ? 1e-7 : 1e-13; }
  std::string options_text(const CodecOptions& /*options*/) const override {
    return "--codec none --precision " + choice_name(*precision());
  }

  std::vector<Slab> slabs(const std::vector<Vec3>& nodes) const override {
    constexpr int kSlabNodes = 32;
    const int count = static_cast<int>(nodes.size());
    std::vector<Slab> slabs;
    for (int first = 0; first < count; first += kSlabNodes)
      slabs.push_back({first, std::min(count, first + kSlabNodes), {}});
    return slabs;
  }
  std::unique_ptr<FamilyBuilder<float>> single_builder(const CodecOptions& options, int nodes,
                                                       int count) const override {
    if constexpr (kSingle)
      return builder(nodes, count);
    else
      return Codec::single_builder(options, nodes, count);
  }
  std::unique_ptr<FamilyBuilder<double>> double_builder(const CodecOptions& options, int nodes,
                                                        int count) const override {
    if constexpr (kSingle)
      return Codec::double_builder(options, nodes, count);
    else
      return builder(nodes, count);
  }
  double expected_bytes(double entries, const CodecOptions& /*options*/) const override {
    return entries * sizeof(T);
  }

  void check_datasets(const Hdf5File& file, const FamilyPlace& place,
                      std::size_t size) const override {
    for (const std::string& path : place.paths)
      file.require_dataset(path, hdf5_type<T>(), {size, size});
  }
  double bytes(const Hdf5File& /*file*/, const FamilyPlace& place,
               std::size_t size) const override {
    return static_cast<double>(place.count()) * static_cast<double>(size * size) * sizeof(T);
  }
  std::unique_ptr<MatrixFamily> read(const Hdf5File& file, const FamilyPlace& place,
                                     std::size_t size, const std::vector<int>* columns,
                                     const BytesReport& report) const override {
    if (columns) return read_dense_columns<T>(file, place, size, *columns, report);
    return read_dense<T>(file, place, size, report);
  }
  void check_numbers(const Hdf5File& file, const FamilyPlace& place, std::size_t size,
                     const BytesReport& report) const override {
    check_dense_numbers<T>(file, place, size, report);
  }

 private:
  static std::unique_ptr<FamilyBuilder<T>> builder(int nodes, int count) {
    return std::make_unique<DenseBuilder<T>>(3 * static_cast<std::size_t>(nodes), count);
  }
};

}  // namespace

const Codec& dense_codec(Precision precision) {
  static const DenseCodec<float> single;
  static const DenseCodec<double> full;
  return precision == Precision::float32 ? static_cast<const Codec&>(single) : full;
}

}  // namespace bem
