#pragma once

namespace bem::test {

/// The same numbers everywhere, uniform in [-1, 1].
class Uniform {
 public:
  explicit Uniform(unsigned seed) : state_(seed * 2654435761u + 12345u) {}
  double operator()() {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(state_ >> 11) / 4503599627370496.0 - 1;
  }
  double between(double low, double high) { return low + (high - low) * 0.5 * ((*this)() + 1); }

 private:
  unsigned long long state_;
};

}  // namespace bem::test
