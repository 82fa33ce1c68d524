// The functions by which a tool and all its libraries allocate memory: those that would be used
// without these, but a failure ends the process (memory.hpp), since BLIS and FFTW abort() then and
// HDF5 is left with broken structures. Only operator new throws. Sanitizers have their own.

#include "common/memory.hpp"

#include <atomic>
#include <cstddef>
#include <new>

#include <dlfcn.h>

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {

/// The function of this name that is used without ours.
template <class Function>
class Hidden {
 public:
  explicit constexpr Hidden(const char* name) : name_(name) {}
  Function* get() {
    Function* function = known_.load(std::memory_order_acquire);
    if (function) return function;
    function = reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name_));
    if (!function) bem::end_without_memory();
    known_.store(function, std::memory_order_release);
    return function;
  }

 private:
  const char* name_;
  std::atomic<Function*> known_{nullptr};
};

Hidden<void*(std::size_t)> hidden_malloc("malloc");
Hidden<void*(std::size_t, std::size_t)> hidden_calloc("calloc");
Hidden<void*(void*, std::size_t)> hidden_realloc("realloc");
Hidden<void*(std::size_t, std::size_t)> hidden_aligned_alloc("aligned_alloc");
Hidden<void*(std::size_t, std::size_t)> hidden_memalign("memalign");
Hidden<int(void**, std::size_t, std::size_t)> hidden_posix_memalign("posix_memalign");

/// Before threads and dlopen(): the loader itself calls realloc() while it changes the structures
/// that dlsym() reads.
[[gnu::constructor]] void find_all() {
  hidden_malloc.get();
  hidden_calloc.get();
  hidden_realloc.get();
  hidden_aligned_alloc.get();
  hidden_memalign.get();
  hidden_posix_memalign.get();
}

/// Who asks for more does so because a file says so, and reports it himself.
constexpr std::size_t kVeryMuch = std::size_t(256) << 20;

void* checked(void* memory, std::size_t size) {
  if (!memory && size > 0 && size < kVeryMuch && bem::is_guarded()) bem::end_without_memory();
  return memory;
}

void* thrown(void* memory) {
  if (!memory) throw std::bad_alloc();
  return memory;
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) noexcept {
  return checked(hidden_malloc.get()(size), size);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  return checked(hidden_calloc.get()(count, size), count * size);
}

void* realloc(void* memory, std::size_t size) noexcept {
  return checked(hidden_realloc.get()(memory, size), size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return checked(hidden_aligned_alloc.get()(alignment, size), size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  return checked(hidden_memalign.get()(alignment, size), size);
}

int posix_memalign(void** out, std::size_t alignment, std::size_t size) noexcept {
  const int error = hidden_posix_memalign.get()(out, alignment, size);
  if (error != 0) checked(nullptr, size);
  return error;
}

}  // extern "C"

void* operator new(std::size_t size) {
  return thrown(hidden_malloc.get()(size > 0 ? size : 1));
}

void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto a = static_cast<std::size_t>(alignment);
  return thrown(hidden_aligned_alloc.get()(a, (size + a - 1) / a * a));
}

#endif
