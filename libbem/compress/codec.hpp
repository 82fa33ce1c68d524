#pragma once

#include "compress/block_partition.hpp"
#include "compress/codec_options.hpp"
#include "compress/family_builder.hpp"
#include "compress/family_storage.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bem {

/// Rows of the matrices of a family by which a builder decides how to store them, and what it may
/// lose.
struct FamilySample {
  const std::vector<Slab>& slabs;  ///< of the whole matrices, in this form
  MatrixForm form;
  const Slab& slab;  ///< the one of them whose rows are here
  const SlabParts<float>& rows;
  double error;  ///< Frobenius norm aimed at, of the whole family
  bool checked;  ///< errors are computed even where they can be extrapolated
};

/// How the large matrices of a body are stored: what a codec is called, how it makes a family of
/// matrices from their rows, and how an archive holds that (docs/archive-format.md). There is one
/// object of each. To add a codec: a class that implements this, and its row in codecs.cpp.
class Codec {
 public:
  virtual ~Codec() = default;

  virtual const char* name() const = 0;
  /// Number format of the entries if all of them are stored as they are.
  virtual std::optional<Precision> precision() const { return std::nullopt; }
  bool is_lossless() const { return precision().has_value(); }
  bool is_double() const { return precision() == Precision::float64; }
  /// Relative error of a product by the rounding of numbers and sums alone, about.
  virtual double rounding() const = 0;
  /// Whether CodecOptions::ratio may say how much is kept.
  virtual bool takes_ratio() const { return false; }
  /// The options of bemprecomp that choose it.
  virtual std::string options_text(const CodecOptions& options) const = 0;

  /// Whether builders want a sample of the rows beforehand, and of symmetric matrices one half
  /// only. If not, builders know what they need by the number of nodes.
  virtual bool is_sampled() const { return false; }
  /// Ranges of nodes whose rows builders take together.
  virtual std::vector<Slab> slabs(const std::vector<Vec3>& nodes) const = 0;
  /// A builder of a sampled codec.
  virtual std::unique_ptr<FamilyBuilder<float>> sampled_builder(const FamilySample& sample) const;
  /// Builders of the others, of `count` matrices of 3 `nodes` rows: single_builder() of those that
  /// do not store double precision.
  virtual std::unique_ptr<FamilyBuilder<float>> single_builder(const CodecOptions& options,
                                                               int nodes, int count) const;
  virtual std::unique_ptr<FamilyBuilder<double>> double_builder(const CodecOptions& options,
                                                                int nodes, int count) const;
  /// Bytes that matrices with so many entries will take; of a sampled codec only samples tell.
  virtual double expected_bytes(double entries, const CodecOptions& options) const;
  /// Bytes of tables in an archive of `families`, which hold `matrices` matrices together.
  virtual double expected_table_bytes(const std::vector<Vec3>& /*nodes*/, double /*families*/,
                                      double /*matrices*/) const {
    return 0;
  }

  // Families in a file, whose matrices have `size` rows. All of these throw ErrorCode::archive
  // where it does not hold what it should.

  /// Checks types and extents of the datasets.
  virtual void check_datasets(const Hdf5File& file, const FamilyPlace& place,
                              std::size_t size) const = 0;
  /// Bytes of large data that read() reads.
  virtual double bytes(const Hdf5File& file, const FamilyPlace& place, std::size_t size) const = 0;
  /// MatrixFamily::coefficients() of the family.
  virtual std::size_t coefficients(const Hdf5File& /*file*/, const FamilyPlace& /*place*/,
                                   std::size_t /*size*/) const {
    return 0;
  }
  /// The family, or with `columns` (ascending) what vectors with entries there need of it.
  virtual std::unique_ptr<MatrixFamily> read(const Hdf5File& file, const FamilyPlace& place,
                                             std::size_t size, const std::vector<int>* columns,
                                             const BytesReport& report) const = 0;
  /// Checks all numbers, as read() does.
  virtual void check_numbers(const Hdf5File& file, const FamilyPlace& place, std::size_t size,
                             const BytesReport& report) const {
    read(file, place, size, nullptr, report);
  }
};

/// The codec of this name, of "none" that with this precision; null if there is none.
const Codec* find_codec(const std::string& name, Precision precision = Precision::float32);
/// The same of a name that is known to exist.
const Codec& codec_named(const std::string& name, Precision precision = Precision::float32);
/// "none", "haar" ...
std::vector<std::string> codec_names();
/// Those of codec_names() with a property.
std::vector<std::string> codecs_with(bool (*property)(const Codec&));
inline bool is_lossy(const Codec& codec) {
  return !codec.is_lossless();
}
inline bool takes_ratio(const Codec& codec) {
  return codec.takes_ratio();
}

/// About the spectral norm of errors of this Frobenius norm in n x n entries, which are spread as
/// if at random.
double spectral_norm_of_errors(double frobenius, Eigen::Index n);

/// A builder of a codec that is not sampled, for rows in this precision.
template <class T>
std::unique_ptr<FamilyBuilder<T>> make_builder(const CodecOptions& options, int nodes, int count) {
  if constexpr (std::is_same_v<T, float>)
    return options.codec->single_builder(options, nodes, count);
  else
    return options.codec->double_builder(options, nodes, count);
}

}  // namespace bem
