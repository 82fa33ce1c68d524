#include "scene/named_materials.hpp"

#include "base/error.hpp"
#include "base/nearest_name.hpp"
#include "scene/location.hpp"
#include "scene/material_json.hpp"

#include <algorithm>
#include <filesystem>

namespace bem {
namespace {

const NamedMaterial* find_named(const std::string& name) {
  const auto& all = named_materials();
  const auto match =
      std::find_if(all.begin(), all.end(), [&](const NamedMaterial& m) { return m.name == name; });
  return match == all.end() ? nullptr : &*match;
}

/// Whether `text`, the path of `file`, looks like one or leads to a file.
bool is_path(const std::string& text, const std::filesystem::path& file) {
  std::error_code unknown;
  return text.find('/') != std::string::npos || file.extension() == ".json" ||
         std::filesystem::exists(file, unknown);
}

constexpr const char* kDataBook =
    "Cambridge University Engineering Department, Materials Data Book (2003)";

}  // namespace

Material NamedMaterial::material() const {
  Material out;
  out.name = name;
  out.density = density;
  out.shear_modulus = youngs_modulus / (2 * (1 + poisson_ratio));
  out.poisson_ratio = poisson_ratio;
  return out;
}

const std::vector<NamedMaterial>& named_materials() {
  static const std::vector<NamedMaterial> all = {
      {"soft silicone", 1070, 8.3e4, 0.49,
       "Smooth-On, Ecoflex series, technical bulletin: 00-50 (1.07 g/cm^3, 100 % modulus 12 psi)"},
      {"soft rubber", 925, 7.3e5, 0.49,
       "A. N. Gent, Rubber Chemistry and Technology 31 (1958), 896: modulus for 20 Shore A"},
      {"rubber", 925, 2e6, 0.49, kDataBook},
      {"silicone", 1300, 5e6, 0.49, kDataBook},
      {"abs", 1100, 2e9, 0.35, kDataBook},
      {"wood", 700, 1.25e10, 0.35,
       "USDA Forest Products Laboratory, Wood Handbook (2010): northern red oak along the grain"},
      {"concrete", 2400, 3e10, 0.2, "Eurocode 2 (EN 1992-1-1), C20/25; density of EN 1991-1-1"},
      {"aluminium", 2700, 7e10, 0.33, kDataBook},
      {"glass", 2470, 7e10, 0.23, kDataBook},
      {"steel", 7850, 2.1e11, 0.29, kDataBook},
  };
  return all;
}

bool is_named_material(const std::string& name) {
  return find_named(name) != nullptr;
}

Material named_material(const std::string& name) {
  if (const NamedMaterial* known = find_named(name)) return known->material();
  std::vector<std::string> names;
  std::string list;
  for (const NamedMaterial& known : named_materials()) {
    names.emplace_back(known.name);
    list += (list.empty() ? "" : ", ") + names.back();
  }
  const std::string nearest = nearest_name(name, names);
  throw Error(ErrorCode::invalid_input,
              "there is no material " + in_quotes(name) +
                  (nearest.empty() ? "" : "; did you mean " + in_quotes(nearest) + "?") +
                  " (materials: " + list + "; or the path of a material file)");
}

Material find_material(const std::string& text, const std::string& folder) {
  const std::filesystem::path file = std::filesystem::path(folder) / text;
  if (!is_named_material(text) && is_path(text, file)) return read_material(file.string());
  return named_material(text);
}

}  // namespace bem
