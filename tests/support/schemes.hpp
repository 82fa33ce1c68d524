#pragma once

namespace bem_test {

/// One scheme of every kind.
inline constexpr const char* kSchemes[] = {"bdf1", "theta:0.75", "bdf2", "radau2", "radau3"};

}  // namespace bem_test
