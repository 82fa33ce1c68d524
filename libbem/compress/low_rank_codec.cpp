#include "compress/low_rank_codec.hpp"

#include "compress/low_rank_builder.hpp"
#include "compress/low_rank_storage.hpp"
#include "mesh/describe.hpp"

namespace bem {
namespace {

class LowRankCodec : public Codec {
 public:
  const char* name() const override { return "lowrank"; }
  double rounding() const override { return 1e-6; }
  std::string options_text(const CodecOptions& options) const override {
    return "--codec lowrank --codec-tol " + to_text(options.tolerance);
  }

  bool is_sampled() const override { return true; }
  std::vector<Slab> slabs(const std::vector<Vec3>& nodes) const override {
    return make_partition(nodes, {});
  }
  std::unique_ptr<FamilyBuilder<float>> sampled_builder(const FamilySample& sample) const override {
    const double quantum =
        LowRankBuilder::choose_quantum(sample.slab, sample.rows, sample.error, sample.checked);
    return std::make_unique<LowRankBuilder>(
        sample.slabs, static_cast<int>(sample.rows.matrices.size()), quantum, sample.form);
  }
  double expected_table_bytes(const std::vector<Vec3>& nodes, double families,
                              double matrices) const override {
    double blocks = 0;
    for (const Slab& s : slabs(nodes)) blocks += static_cast<double>(s.blocks.size());
    return blocks *
           (LowRankFamily::kBlockBytes * families + LowRankFamily::kCouplingBytes * matrices);
  }

  void check_datasets(const Hdf5File& file, const FamilyPlace& place,
                      std::size_t /*size*/) const override {
    check_family_group(file, place,
                       {{"/slabs", Hdf5Type::int32, 3},
                        {"/blocks", Hdf5Type::int32, 17},
                        {"/couplings", Hdf5Type::int32, 6},
                        {"/analysis", Hdf5Type::uint8},
                        {"/synthesis", Hdf5Type::uint8},
                        {"/input_scales", Hdf5Type::float32},
                        {"/output_scales", Hdf5Type::float32}});
  }
  double bytes(const Hdf5File& file, const FamilyPlace& place,
               std::size_t /*size*/) const override {
    return static_cast<double>(bytes_in_group(file, place, {"/analysis", "/synthesis"}));
  }
  std::size_t coefficients(const Hdf5File& file, const FamilyPlace& place,
                           std::size_t /*size*/) const override {
    return low_rank_coefficients(file, place.group);
  }
  std::unique_ptr<MatrixFamily> read(const Hdf5File& file, const FamilyPlace& place,
                                     std::size_t size, const std::vector<int>* columns,
                                     const BytesReport& report) const override {
    return read_low_rank(file, place.group, size, place.count(), columns, report);
  }
};

}  // namespace

const Codec& low_rank_codec() {
  static const LowRankCodec codec;
  return codec;
}

}  // namespace bem
