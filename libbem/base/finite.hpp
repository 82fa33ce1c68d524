#pragma once

#include <cstddef>

namespace bem {

/// Whether none of the numbers is infinite or NaN; on all worker threads, at the speed of memory.
bool all_finite(const float* numbers, std::size_t count);
bool all_finite(const double* numbers, std::size_t count);

}  // namespace bem
