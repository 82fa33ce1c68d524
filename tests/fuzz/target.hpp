#pragma once

#include "base/error.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

// A reader that is fuzzed. Every target is one file with the two functions below; libfuzzer.cpp and
// replay.cpp call them.

namespace bem_fuzz {

/// Gives an input to the reader and uses what it made of it. Returns whether it was accepted.
/// Aborts if the reader breaks its promises: input is either understood or refused with an Error
/// that is the input's fault.
bool run(const std::string& input);

/// Makes a changed input such that it gets past checksums, if the format has any.
std::string repaired(std::string input);

/// Calls f and returns true, or false if f refuses with an Error of the codes that input may cause.
template <class F>
bool accepted(const F& f) {
  try {
    f();
    return true;
  } catch (const bem::Error& e) {
    const bool fault_of_input = e.code() == bem::ErrorCode::invalid_input ||
                                e.code() == bem::ErrorCode::archive ||
                                e.code() == bem::ErrorCode::numerical;
    if (fault_of_input && std::string(e.what()).size() < 4000) return false;
    std::fprintf(stderr, "refused with code %d: %s\n", static_cast<int>(e.code()), e.what());
    std::abort();
  }
}

}  // namespace bem_fuzz
