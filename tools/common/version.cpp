#include "common/version.hpp"

namespace bem {

std::string version_text() {
  return std::string("bem ") + BEM_VERSION;
}

}  // namespace bem
