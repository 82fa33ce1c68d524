#include "base/aligned.hpp"

#include <sys/mman.h>

namespace bem {
namespace {

constexpr std::size_t kCacheLine = 64, kLargePage = std::size_t(2) << 20;

/// From a few large pages on.
std::align_val_t alignment_of(std::size_t bytes) {
  return std::align_val_t(bytes >= 4 * kLargePage ? kLargePage : kCacheLine);
}

}  // namespace

void* allocate_aligned(std::size_t bytes) {
  const std::align_val_t alignment = alignment_of(bytes);
  void* memory = ::operator new(bytes, alignment);
  if (static_cast<std::size_t>(alignment) == kLargePage)
    madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: without it everything works as well
  return memory;
}

void deallocate_aligned(void* memory, std::size_t bytes) {
  ::operator delete(memory, alignment_of(bytes));
}

}  // namespace bem
