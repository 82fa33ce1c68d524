/// Scene files.

#include "scene/scene_json.hpp"
#include "target.hpp"

namespace bem_fuzz {

bool run(const std::string& input) {
  return accepted([&] { bem::parse_scene("input.json", input); });
}

std::string repaired(std::string input) {
  return input;
}

}  // namespace bem_fuzz
