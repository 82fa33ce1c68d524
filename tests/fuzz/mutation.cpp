#include "mutation.hpp"

#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>

namespace bem_fuzz {
namespace {

class Mutation {
 public:
  Mutation(std::string& input, std::mt19937_64& random) : input_(input), random_(random) {}

  void apply() {
    switch (below(8)) {
      case 0:
        input_[place(1)] ^= static_cast<char>(1U << below(8));
        break;
      case 1:
        input_[place(1)] = static_cast<char>(below(256));
        break;
      case 2:
        put_integer();
        break;
      case 3:
        put_number();
        break;
      case 4:
        nudge();
        break;
      default:
        move_piece();
    }
  }

 private:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }
  std::size_t place(std::size_t size) { return below(input_.size() - size + 1); }

  template <class T>
  void put(T value) {
    if (input_.size() >= sizeof value)
      std::memcpy(&input_[place(sizeof value) / alignment() * alignment()], &value, sizeof value);
  }
  /// Numbers in files are mostly aligned to 4 bytes.
  static constexpr std::size_t alignment() { return 4; }

  void put_integer() {
    constexpr std::uint64_t kEdges[] = {0,          1,          2,          3,         127,
                                        128,        255,        256,        32767,     65535,
                                        65536,      1U << 20,   ~0ULL,      1U << 31,  0x7fffffff,
                                        0xffffffff, 1ULL << 32, 1ULL << 62, 1ULL << 63};
    const std::uint64_t value = kEdges[below(std::size(kEdges))];
    if (below(2) == 0)
      put(static_cast<std::uint32_t>(value));
    else
      put(value);
  }

  void put_number() {
    constexpr double kEdges[] = {0,
                                 -1,
                                 1,
                                 1e-320,
                                 1e-30,
                                 1e30,
                                 1e300,
                                 -1e300,
                                 std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::quiet_NaN()};
    const double value = kEdges[below(std::size(kEdges))];
    if (below(3) == 0)
      put(static_cast<float>(value));
    else
      put(value);
  }

  /// Adds a small number to an integer.
  void nudge() {
    if (input_.size() < 4) return;
    const std::size_t at = place(4) / alignment() * alignment();
    std::uint32_t value = 0;
    std::memcpy(&value, &input_[at], sizeof value);
    value += static_cast<std::uint32_t>(below(7)) - 3;
    std::memcpy(&input_[at], &value, sizeof value);
  }

  void move_piece() {
    const std::size_t most = std::min<std::size_t>(input_.size(), 64);
    const std::size_t size = 1 + below(most), from = place(size);
    const std::string piece = input_.substr(from, size);
    switch (below(4)) {
      case 0:
        input_.replace(place(size), size, piece);
        break;
      case 1:
        input_.insert(below(input_.size()), piece);
        break;
      case 2:
        if (size < input_.size()) input_.erase(from, size);
        break;
      default:
        if (below(4) == 0) input_.resize(1 + below(input_.size()));
    }
  }

  std::string& input_;
  std::mt19937_64& random_;
};

}  // namespace

std::string mutated(std::string input, std::mt19937_64& random) {
  if (input.empty()) return "x";
  for (std::uint64_t n = 1 + random() % 4; n > 0; --n) Mutation(input, random).apply();
  return input;
}

}  // namespace bem_fuzz
