#include "compress/direct_builder.hpp"

#include "base/error.hpp"
#include "compress/dense_family.hpp"
#include "compress/haar_builder.hpp"

#include <algorithm>

namespace bem {

template <class T>
std::unique_ptr<FamilyBuilder<T>> make_direct_builder(const CodecOptions& options, int nodes,
                                                      int count) {
  if constexpr (std::is_same_v<T, float>)
    if (options.codec == Codec::haar) return std::make_unique<HaarBuilder>(nodes, count, options);
  require(options.codec == Codec::none, "the codec takes rows of this precision directly");
  return std::make_unique<DenseBuilder<T>>(3 * static_cast<std::size_t>(nodes), count);
}

template std::unique_ptr<FamilyBuilder<float>> make_direct_builder(const CodecOptions&, int, int);
template std::unique_ptr<FamilyBuilder<double>> make_direct_builder(const CodecOptions&, int, int);

std::vector<Slab> direct_slabs(const CodecOptions& options, int nodes) {
  constexpr int kDenseNodes = 32;
  std::vector<Slab> slabs;
  if (options.codec == Codec::haar) {
    const std::vector<int> firsts = HaarBuilder::slabs(nodes);
    for (std::size_t s = 0; s + 1 < firsts.size(); ++s)
      slabs.push_back({firsts[s], firsts[s + 1], {}});
  } else {
    for (int first = 0; first < nodes; first += kDenseNodes)
      slabs.push_back({first, std::min(nodes, first + kDenseNodes), {}});
  }
  return slabs;
}

}  // namespace bem
