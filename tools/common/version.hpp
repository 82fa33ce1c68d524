#pragma once

#include <string>

namespace bem {

/// "bem 0.1.0".
std::string version_text();

}  // namespace bem
