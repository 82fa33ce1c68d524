#include "scene/material_json.hpp"

#include "scene/json_reader.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

constexpr std::size_t kLongestName = 1000;

Material material_from(const JsonDocument& document) {
  return read_material(JsonValue(document, 0));
}

}  // namespace

Material read_material(const JsonValue& object) {
  JsonReader reader(object, "a material");
  Material material;
  material.name = reader.required("name").text();
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  if (material.name.size() > kLongestName ||
      std::any_of(material.name.begin(), material.name.end(), is_control))
    throw error_at(reader.required("name").location(),
                   "a name has at most " + std::to_string(kLongestName) +
                       " bytes, none of which are control characters");
  material.density = reader.required("density").positive();
  material.poisson_ratio = reader.required("poisson_ratio").number_in(0, 0.5);
  const std::string modulus = reader.required_one_of({"shear_modulus", "youngs_modulus"});
  material.shear_modulus = reader.required(modulus).positive();
  if (modulus == "youngs_modulus") material.shear_modulus /= 2 * (1 + material.poisson_ratio);
  if (const auto dt = reader.optional("time_step")) material.time_step = dt->positive();
  reader.finish();
  if (!std::isnormal(material.shear_speed()))
    throw error_at(reader.location(),
                   "the speed of shear waves, sqrt(shear modulus / density), is out of range");
  return material;
}

Material read_material(const std::string& path) {
  return material_from(JsonDocument::read(path));
}

Material parse_material(const std::string& file, const std::string& text) {
  return material_from(JsonDocument::parse(file, text));
}

}  // namespace bem
