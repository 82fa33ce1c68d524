/// What libFuzzer calls (clang -fsanitize=fuzzer).

#include "mutation.hpp"
#include "target.hpp"

#include <cstring>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // what was refused is of interest, too: the way to the refusal is new code
  bem_fuzz::run(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}

/// The changes of libFuzzer, which learns, and those of the replay, which know numbers; both get
/// past checksums.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  std::mt19937_64 random(seed);
  std::string input;
  if (random() % 2 == 0) {
    input.assign(reinterpret_cast<const char*>(data), LLVMFuzzerMutate(data, size, most));
  } else {
    input = bem_fuzz::mutated(std::string(reinterpret_cast<const char*>(data), size), random);
  }
  input = bem_fuzz::repaired(std::move(input));
  const std::size_t kept = std::min(most, input.size());
  std::memcpy(data, input.data(), kept);
  return kept;
}
