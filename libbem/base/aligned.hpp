#pragma once

#include <cstdlib>
#include <limits>
#include <new>
#include <utility>
#include <vector>

namespace bem {

/// Memory that starts on a cache line, as vector loads want it; large pieces start on a page of 2
/// MB and ask the system for such pages, of which it has fewer to set up and to look up. Throws
/// std::bad_alloc.
void* allocate_aligned(std::size_t bytes);
/// `bytes`: as allocated.
void deallocate_aligned(void* memory, std::size_t bytes);

/// Allocator of such memory.
template <class T>
struct AlignedAllocator {
  using value_type = T;

  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}

  T* allocate(std::size_t n) {
    if (n > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(allocate_aligned(n * sizeof(T)));
  }
  void deallocate(T* p, std::size_t n) { deallocate_aligned(p, n * sizeof(T)); }

  /// resize() leaves new numbers as they are in memory.
  template <class U>
  void construct(U* p) {
    ::new (static_cast<void*>(p)) U;
  }
  template <class U, class... Args>
  void construct(U* p, Args&&... args) {
    ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }

  template <class U>
  bool operator==(const AlignedAllocator<U>&) const {
    return true;
  }
  template <class U>
  bool operator!=(const AlignedAllocator<U>&) const {
    return false;
  }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace bem
