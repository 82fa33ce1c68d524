#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace bem {

/// While it lives, this thread takes numbers below the smallest normal one (1e-38 in single
/// precision) for zero. Kernels of lags that waves have not reached yet, or have long left, are
/// full of them, and some processors take many times as long for each. Known for x86-64 and
/// 64-bit ARM; elsewhere it does nothing.
class FlushDenormals {
 public:
  FlushDenormals() : before_(state()) { set_state(before_ | kFlush); }
  ~FlushDenormals() { set_state(before_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
#if defined(__SSE2__)
  static constexpr std::uint64_t kFlush = 0x8040;  // results and operands
  static std::uint64_t state() {
    return _mm_getcsr();
  }
  static void set_state(std::uint64_t s) {
    _mm_setcsr(static_cast<unsigned>(s));
  }
#elif defined(__aarch64__)
  static constexpr std::uint64_t kFlush = std::uint64_t{1} << 24;
  static std::uint64_t state() {
    std::uint64_t s;
    asm volatile("mrs %0, fpcr" : "=r"(s));
    return s;
  }
  static void set_state(std::uint64_t s) {
    asm volatile("msr fpcr, %0" : : "r"(s));
  }
#else
  static constexpr std::uint64_t kFlush = 0;
  static std::uint64_t state() {
    return 0;
  }
  static void set_state(std::uint64_t) {}
#endif

  std::uint64_t before_;
};

}  // namespace bem
