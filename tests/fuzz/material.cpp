/// Material files.

#include "scene/material_json.hpp"
#include "target.hpp"

namespace bem_fuzz {

bool run(const std::string& input) {
  return accepted([&] { bem::parse_material("input.json", input); });
}

std::string repaired(std::string input) {
  return input;
}

}  // namespace bem_fuzz
