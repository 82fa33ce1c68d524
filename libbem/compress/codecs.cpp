#include "base/error.hpp"
#include "compress/dense_codec.hpp"
#include "compress/haar_codec.hpp"
#include "compress/low_rank_codec.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

/// All codecs, in the order in which messages list them.
const std::vector<const Codec*>& all_codecs() {
  static const std::vector<const Codec*> codecs = {&dense_codec(Precision::float32),
                                                   &dense_codec(Precision::float64), &haar_codec(),
                                                   &low_rank_codec()};
  return codecs;
}

[[noreturn]] void no_such_builder(const Codec& codec) {
  throw Error(ErrorCode::internal,
              "codec " + std::string(codec.name()) + " is not built from such rows");
}

}  // namespace

CodecOptions::CodecOptions() : codec(&dense_codec(Precision::float32)) {}

std::unique_ptr<FamilyBuilder<float>> Codec::sampled_builder(const FamilySample& /*sample*/) const {
  no_such_builder(*this);
}

std::unique_ptr<FamilyBuilder<float>> Codec::single_builder(const CodecOptions& /*options*/,
                                                            int /*nodes*/, int /*count*/) const {
  no_such_builder(*this);
}

std::unique_ptr<FamilyBuilder<double>> Codec::double_builder(const CodecOptions& /*options*/,
                                                             int /*nodes*/, int /*count*/) const {
  no_such_builder(*this);
}

double Codec::expected_bytes(double /*entries*/, const CodecOptions& /*options*/) const {
  throw Error(ErrorCode::internal, "the size of a sampled codec is not known beforehand");
}

const Codec* find_codec(const std::string& name, Precision precision) {
  for (const Codec* codec : all_codecs())
    if (codec->name() == name && codec->precision().value_or(precision) == precision) return codec;
  return nullptr;
}

const Codec& codec_named(const std::string& name, Precision precision) {
  const Codec* codec = find_codec(name, precision);
  require(codec != nullptr, "the codec exists");
  return *codec;
}

std::vector<std::string> codec_names() {
  std::vector<std::string> names;
  for (const Codec* codec : all_codecs())
    if (names.empty() || names.back() != codec->name()) names.emplace_back(codec->name());
  return names;
}

std::vector<std::string> codecs_with(bool (*property)(const Codec&)) {
  std::vector<std::string> names = codec_names();
  names.erase(std::remove_if(names.begin(), names.end(),
                             [&](const std::string& name) { return !property(codec_named(name)); }),
              names.end());
  return names;
}

double spectral_norm_of_errors(double frobenius, Eigen::Index n) {
  return 2 * frobenius / std::sqrt(static_cast<double>(n));
}

}  // namespace bem
