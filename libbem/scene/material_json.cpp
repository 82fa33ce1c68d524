#include "scene/material_json.hpp"

#include "scene/named_materials.hpp"
#include "scene/scene_parts.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace bem {
namespace {

constexpr std::size_t kLongestName = 1000;

enum class Place { file, scene };

Material material_from(const JsonValue& value, Place place) {
  JsonReader reader(value, "a material");
  Material material;
  material.name = reader.required("name").text();
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  if (material.name.size() > kLongestName ||
      std::any_of(material.name.begin(), material.name.end(), is_control))
    throw error_at(reader.required("name").location(),
                   "a name has at most " + std::to_string(kLongestName) +
                       " bytes, none of which are control characters");
  material.density = reader.required("density").positive(dimension::density);
  material.poisson_ratio = reader.required("poisson_ratio").number_in(0, 0.5);
  const std::string modulus = reader.required_one_of({"shear_modulus", "youngs_modulus"});
  material.shear_modulus = reader.required(modulus).positive(dimension::pressure);
  if (modulus == "youngs_modulus") material.shear_modulus /= 2 * (1 + material.poisson_ratio);
  if (place == Place::scene)
    reader.refuse("time_step",
                  "is no key of a material in a scene, which has a \"time_step\" itself");
  else if (const auto dt = reader.optional("time_step"))
    material.time_step = dt->positive(dimension::time);
  reader.finish();
  if (!std::isnormal(material.shear_speed()))
    throw error_at(reader.location(),
                   "the speed of shear waves, sqrt(shear modulus / density), is out of range");
  return material;
}

}  // namespace

Material read_material(const std::string& path) {
  const JsonDocument document = JsonDocument::read(path);
  return material_from(JsonValue(document, document.root()), Place::file);
}

Material parse_material(const std::string& file, const std::string& text) {
  const JsonDocument document = JsonDocument::parse(file, text);
  return material_from(JsonValue(document, document.root()), Place::file);
}

Material read_material_value(const JsonValue& value) {
  if (value.kind() == JsonKind::object) return material_from(value, Place::scene);
  if (value.kind() != JsonKind::string)
    throw value.unexpected("a material (a name, a path, or an object)");
  const FilePath path = read_path(value);
  const std::string folder = std::filesystem::path(value.location().file).parent_path().string();
  return at_place(value.location(), [&] { return find_material(path.written, folder); });
}

}  // namespace bem
