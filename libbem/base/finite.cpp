#include "base/finite.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <atomic>

namespace bem {
namespace {

constexpr std::size_t kPiece = std::size_t(1) << 16;  // numbers that one thread looks at

/// x * 0 is 0 for finite x and NaN for others, and NaN stays in a sum. Independent sums, so that
/// the compiler can use vectors.
template <class T>
bool piece_is_finite(const T* numbers, std::size_t count) {
  constexpr std::size_t kSums = 64 / sizeof(T);
  T sums[kSums] = {};
  std::size_t i = 0;
  for (; i + kSums <= count; i += kSums)
    for (std::size_t s = 0; s < kSums; ++s) sums[s] += numbers[i + s] * T(0);
  for (; i < count; ++i) sums[0] += numbers[i] * T(0);
  T sum = 0;
  for (T s : sums) sum += s;
  return sum == T(0);
}

template <class T>
bool are_finite(const T* numbers, std::size_t count) {
  if (count <= kPiece) return piece_is_finite(numbers, count);
  std::atomic<bool> finite{true};
  parallel_for((count + kPiece - 1) / kPiece, [&](std::size_t piece) {
    const std::size_t first = piece * kPiece;
    if (!piece_is_finite(numbers + first, std::min(kPiece, count - first))) finite = false;
  });
  return finite;
}

}  // namespace

bool all_finite(const float* numbers, std::size_t count) {
  return are_finite(numbers, count);
}

bool all_finite(const double* numbers, std::size_t count) {
  return are_finite(numbers, count);
}

}  // namespace bem
